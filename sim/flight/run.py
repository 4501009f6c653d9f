# SPDX-License-Identifier: Apache-2.0
"""Flies one landing with the firmware's core in this process, prints its steps, and draws it.

    python -m sim.flight.run [--profile ardupilot|px4] [--gusts 0.5] [--seed 1]

Exit code 1 if it does not end on the pad with motors off.
"""

import math
import random
from pathlib import Path

from firmware.library import make
from scripts.errors import ArgumentParser, UserError, run_main
from sim.flight.autopilot import ARDUPILOT, PX4, Autopilot
from sim.flight.board import HostBoard
from sim.flight.picture import landing_svg
from sim.flight.scenario import Flight
from sim.flight.vehicle import Vehicle

OUT = Path("build/flight")
PICTURE_EVERY = 10
_LIMIT_S = 120.0
_START_S = 2.5
_GUST_S = 0.5


def fly(profile: str, gusts_m_s2: float, seed: int) -> Flight:
    """Fly a landing from a random place within 1 m of the pad.

    Args:
        profile: Of the autopilot.
        gusts_m_s2: Standard deviation of the acceleration by gusts, along each axis.
        seed: Of place, heading and gusts.
    """
    chance = random.Random(seed)
    vehicle = Vehicle(
        north_m=chance.uniform(-0.7, 0.7),
        east_m=chance.uniform(-0.7, 0.7),
        height_m=chance.uniform(1.5, 2.0),
        heading_rad=chance.uniform(-math.pi, math.pi),
    )
    gusts = [(chance.gauss(0, gusts_m_s2), chance.gauss(0, gusts_m_s2)) for _ in range(int(_LIMIT_S / _GUST_S) + 1)]
    flight = Flight(Autopilot(profile, vehicle), HostBoard(), wind=lambda time_s: gusts[int(time_s / _GUST_S)])
    flight.run(_START_S)
    flight.switch(True)
    flight.run(_LIMIT_S - 1, lambda flying: not flying.autopilot.armed)
    flight.run(min(flight.time_s + 0.5, _LIMIT_S))
    return flight


def main(arguments: list[str] | None = None) -> int:
    """Entry point; 1 if it has not landed."""
    parser = ArgumentParser(prog="python -m sim.flight.run", description=__doc__)
    parser.add_argument("--profile", choices=(ARDUPILOT, PX4), default=ARDUPILOT, help="the autopilot")
    parser.add_argument("--gusts", type=float, default=0.5, help="standard deviation of gusts, m/s^2")
    parser.add_argument("--seed", type=int, default=1, help="of place, heading and gusts")
    parser.add_argument("--out", type=Path, default=OUT, help="folder for the picture")
    options = parser.parse_args(arguments)
    if not 0 <= options.gusts <= 3:
        raise UserError(f"gusts of {options.gusts} m/s^2 are none or too many; give 0 to 3.")
    make("host")
    flight = fly(options.profile, options.gusts, options.seed)
    print("\n".join(f"{time_s:7.2f} s  {text}" for time_s, text in flight.texts))
    vehicle = flight.vehicle
    off_m = math.hypot(vehicle.north_m, vehicle.east_m)
    off_deg = math.degrees(math.remainder(vehicle.heading_rad, math.tau))
    print(f"\n{100 * off_m:.1f} cm from the pad's centre, {off_deg:+.1f} degrees from its orientation.")
    options.out.mkdir(parents=True, exist_ok=True)
    picture = options.out / "landing.svg"
    title = f"A landing in simulation: {options.profile}, gusts of {options.gusts:g} m/s², seed {options.seed}"
    picture.write_text(landing_svg(title, flight.track[::PICTURE_EVERY], flight.phases), encoding="utf-8")
    print(f"Picture: {picture}.")
    return int(flight.autopilot.armed)


if __name__ == "__main__":
    run_main(main)
