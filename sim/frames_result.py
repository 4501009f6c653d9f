# SPDX-License-Identifier: Apache-2.0
"""What a run of whole frames gave in one simulator, and what all runs together say of each core."""

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from scripts.signoff import leave
from scripts.signoff_inputs import digest
from sim.compare_stages import Report
from sim.cosim.build import ROOT

CHECK = "frames"
OUTPUT = ROOT / "build" / "frames"
VERILATOR = "verilator"
ICARUS = "icarus"

CORE_OF_STAGE = {
    "rgb": "video_in",
    "gray": "rgb2gray",
    "smooth": "gaussian5x5",
    "checked": "threshold_stats",
    "stats": "threshold_stats",
    "binary": "threshold_apply",
    "eroded": "erode3x3",
    "median": "median5x5",
    "dilated": "dilate3x3",
    "objects": "ccl",
    "record": "result_writer",
}
WHOLE = "landing_core"
CORES = tuple(dict.fromkeys([*CORE_OF_STAGE.values(), WHOLE]))
LEAST_RENDERED, LEAST_PHOTOS, LEAST_IN_ICARUS = 20, 20, 3


@dataclass(frozen=True)
class Mismatch:
    """The first difference: the core that made it, and one sentence."""

    core: str
    says: str


@dataclass(frozen=True)
class Tally:
    """What was compared in one simulator until its end or its first difference."""

    rendered: int = 0
    photos: int = 0
    objects: int = 0
    clocks: int = 0
    seconds: float = 0.0
    mismatch: Mismatch | None = None

    @property
    def frames(self) -> int:
        """How many frames were equal."""
        return self.rendered + self.photos

    def plus(self, rendered: int, photos: int, report: Report) -> "Tally":
        """With more frames, which may be fewer than the run showed."""
        return Tally(
            self.rendered + rendered,
            self.photos + photos,
            self.objects + report.objects,
            self.clocks + report.clocks,
            self.seconds + report.seconds,
        )


def digest_of_sources() -> str:
    """Tells one state of landing_core, its models and the simulation from another."""
    return digest(WHOLE, CHECK)


def keep(simulator: str, tally: Tally, sources: str, output: Path) -> None:
    """Keep the tally of one simulator in `output`, with the state of the sources that it is about."""
    output.mkdir(parents=True, exist_ok=True)
    partial = output / f"{simulator}.partial"
    partial.write_text(json.dumps({**asdict(tally), "sources": sources}) + "\n", encoding="utf-8")
    partial.replace(output / f"{simulator}.json")


def kept(simulator: str, sources: str, output: Path) -> Tally | None:
    """The tally of one simulator if it is about this state of the sources."""
    path = output / f"{simulator}.json"
    table = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    if table.pop("sources", None) != sources:
        return None
    mismatch = table.pop("mismatch")
    return Tally(**table, mismatch=Mismatch(**mismatch) if mismatch else None)


def sum_up(output: Path) -> list[Mismatch]:
    """Leave the result of each core from what the simulators gave for the sources as they are now.

    A core has passed when enough frames were compared and no simulator showed a difference in any core: after a
    difference no core was seen to the end. Too few frames leave every core incomplete, with what is still needed.

    Returns:
        What is wrong; nothing if all passed.
    """
    sources = digest_of_sources()
    tallies = {name: kept(name, sources, output) or Tally() for name in (VERILATOR, ICARUS)}
    mismatches = [tally.mismatch for tally in tallies.values() if tally.mismatch]
    most = tallies[VERILATOR]
    if not mismatches and most.frames and not most.objects:
        mismatches = [Mismatch(WHOLE, "no frame showed an object in Verilator, so little was compared")]
    needed = _needed(most, tallies[ICARUS])
    figure = f"{most.rendered} rendered + {most.photos} photos, {tallies[ICARUS].frames} in Icarus{needed}"
    detail = {name: asdict(tally) for name, tally in tallies.items()}
    for core in CORES:
        passed = not mismatches and not needed
        leave(core, CHECK, passed, _own(core, mismatches) or figure, detail, incomplete=not mismatches)
    return mismatches


def _needed(most: Tally, in_icarus: Tally) -> str:
    """What is still to be shown before the cores can pass; empty if nothing is."""
    if most.photos < LEAST_PHOTOS:
        return f'; needs {LEAST_PHOTOS} photos: make test-full PHOTOS="folder ..."'
    if most.rendered < LEAST_RENDERED or in_icarus.frames < LEAST_IN_ICARUS:
        return f"; needs {LEAST_RENDERED} rendered and {LEAST_IN_ICARUS} in Icarus"
    return ""


def _own(core: str, mismatches: Sequence[Mismatch]) -> str:
    own = [mismatch.says for mismatch in mismatches if mismatch.core == core]
    if mismatches and not own:
        return f"not compared to the end: {mismatches[0].core} differs"
    return "; ".join(own)
