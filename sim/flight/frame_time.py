# SPDX-License-Identifier: Apache-2.0
"""How many instructions a frame of a photograph takes on the board, counted on QEMU.

    python -m sim.flight.frame_time FOLDER [--altitude METRES]

Each photograph is shown to a board that has just been switched on. The first frame in which its pad is found is one in
which it was searched for; in those after it, it is where it was. Without a pad every frame is searched in vain.
"""

import statistics

import numpy as np

from golden.generated.landing_regs import RECORD_DTYPE
from scripts.errors import ArgumentParser, UserError, run_main
from sim.accuracy.paths import golden
from sim.accuracy.photos import photo_units
from sim.accuracy.run import build
from sim.accuracy.shots import develop
from sim.flight.board import ZynqBoard

SPANS = {
    "target": ("landing_hw_take_frame", "wait_until"),
    "record": ("landing_hw_take_frame", "landing_hw_adapt"),
}
"""From the copy of a record to a LANDING_TARGET that waits to be sent, or to the end of it all where there is none."""
_START_US = 100_000
_FRAME_US = 70_000
_FRAMES = 8


def instructions_of(records: list[np.void]) -> tuple[list[int], list[int]]:
    """Instructions of each frame in which a pad is found, and of every frame with all that waits, on a new board.

    Args:
        records: `RECORD_DTYPE` scalars, one a frame, as landing_core would leave them.
    """
    board = ZynqBoard(SPANS)
    try:
        board.run_to(_START_US, None)
        for number, record in enumerate(records, 1):
            header = record["header"]
            board.show(record["objects"][: header["object_count"]])
            board.run_to(_START_US + number * _FRAME_US, int(header["altitude_mm"]) or None)
        return board.passes("target"), board.passes("record")
    finally:
        board.close()


def main(arguments: list[str] | None = None) -> int:
    """Entry point of the command line."""
    parser = ArgumentParser(prog="python -m sim.flight.frame_time", description=__doc__)
    parser.add_argument("folder", help="photographs, as make accuracy takes them")
    parser.add_argument("--altitude", help="metres, or a CSV file (default: altitude.csv of each set)")
    options = parser.parse_args(arguments)
    if not options.folder:
        raise UserError("no photographs are named; give FRAMES=folder.")
    build("golden")
    searched: list[int] = []
    tracked: list[int] = []
    missed: list[int] = []
    print(f"{'photograph':40s} {'objects':>8s} {'searched':>9s} {'tracked':>9s}")
    for unit in photo_units(options.folder, options.altitude):
        records = [frame.record for frame in golden(develop(unit)).frames][:_FRAMES]
        assert all(record.dtype == RECORD_DTYPE for record in records)
        passes, every = instructions_of(records)
        name = f"{unit.set.removeprefix('photos:')}/{unit.shots[0].name}"
        most = max(int(record["header"]["object_count"]) for record in records)
        if len(passes) < 2:
            print(f"{name:40s} {most:8d} {max(every):9d} no pad in {len(records)} frames", flush=True)
            missed.append(max(every))
            continue
        print(f"{name:40s} {most:8d} {passes[0]:9d} {max(passes[1:]):9d}", flush=True)
        searched.append(passes[0])
        tracked.append(max(passes[1:]))
    for what, counts in (("searched", searched), ("tracked", tracked), ("without a pad", missed)):
        if counts:
            print(f"{what}: median {statistics.median(counts):.0f}, at most {max(counts)} of {len(counts)} photographs")
    return 0


if __name__ == "__main__":
    run_main(main)
