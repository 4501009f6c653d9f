# SPDX-License-Identifier: Apache-2.0
"""Whole frames of 1280x720 through landing_core, each stream between its stages equal to the golden models.

Rendered views and photos go through the verilated model, some of them through Icarus beside it. Leaves the result of
the check `frames` of each core on the way of the pixels.
"""

import re
import shutil
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, replace
from itertools import zip_longest
from pathlib import Path

import numpy as np

from scripts.errors import ArgumentParser, UserError, run_main
from scripts.frames import open_frames, read_picture
from scripts.signoff import leave
from sim.compare_stages import Report, Simulate, StageMismatchError, compare, verilated
from sim.cosim.build import ROOT
from sim.icarus.run import landing_core_sources
from sim.icarus.run import simulate as icarus
from sim.views import views

CHECK = "frames"
OUTPUT = ROOT / "build" / "frames"
BATCH = 8
"""Frames a run that count: the streams of each take 17 MB on disk and again in memory."""

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


@dataclass(frozen=True)
class Shot:
    """One frame: what it is, for a person, and how to get its pixels."""

    name: str
    image: Callable[[], np.ndarray]


@dataclass(frozen=True)
class Mismatch:
    """The first difference: the core that made it, and one sentence."""

    core: str
    says: str


@dataclass(frozen=True)
class Tally:
    """What was compared in one simulator until its end or its first difference."""

    frames: int = 0
    objects: int = 0
    clocks: int = 0
    seconds: float = 0.0
    mismatch: Mismatch | None = None

    def plus(self, frames: int, report: Report) -> "Tally":
        """With `frames` more, which may be fewer than the run showed."""
        return Tally(
            self.frames + frames,
            self.objects + report.objects,
            self.clocks + report.clocks,
            self.seconds + report.seconds,
        )


def rendered_shots(count: int) -> list[Shot]:
    """Views of the pad from the renderer."""
    return [Shot(f"rendered view {index}", view.image) for index, view in enumerate(views(count))]


def photo_shots(folders: Sequence[str]) -> list[Shot]:
    """All pictures of some folders.

    Raises:
        UserError: a folder has none, or one of them cannot be read.
    """
    shots = []
    for folder in folders:
        if not Path(folder).is_dir():
            raise UserError(f"{folder} is not a folder; give folders of PNG or JPEG pictures, or none.")
        for name in open_frames(folder).names:
            path = Path(folder) / name
            shots.append(Shot(f"photo {path}", lambda path=path: read_picture(path)))
    return shots


def batches(shots: Sequence[Shot], size: int = BATCH) -> Iterator[tuple[list[Shot], int]]:
    """Runs of at most `size` frames, and how many of each run count.

    The first frame of a run has no thresholds: all of its binary stages are empty. So each run starts with a frame that
    does not count, the last one of the run before, and of the first run the last of all.
    """
    for start in range(0, len(shots), size):
        some = shots[start : start + size]
        yield [shots[start - 1], *some], len(some)


def explain(error: StageMismatchError, shots: Sequence[Shot]) -> Mismatch:
    """Whose difference it is, and in which frame."""
    says = str(error)
    place = re.search(r"\bstage (\w+)|\b(record)\b", says)
    core = CORE_OF_STAGE.get(place[1] or place[2], WHOLE) if place else WHOLE
    frame = re.search(r"\bframe (\d+)", says)
    if frame and int(frame[1]) < len(shots):
        says += f" (frame {frame[1]} is {shots[int(frame[1])].name})"
    return Mismatch(core, says)


def run(
    simulator: str,
    runs: Iterable[tuple[Sequence[Shot], int]],
    out_dir: Path,
    simulate: Simulate,
    tell: Callable[[str], None],
) -> Tally:
    """Compare run by run up to the first difference; the files of good runs are removed."""
    tally = Tally()
    for shown, counted in runs:
        if out_dir.exists():
            shutil.rmtree(out_dir)
        try:
            report = compare((shot.image() for shot in shown), out_dir, simulate=simulate)
        except StageMismatchError as error:
            mismatch = explain(error, shown)
            tell(f"{simulator}: DIFFERENT: {mismatch.core}: {mismatch.says}; files: {out_dir}")
            return replace(tally, mismatch=mismatch)
        shutil.rmtree(out_dir)
        tally = tally.plus(counted, report)
        rate = tally.clocks / tally.seconds / 1000
        tell(f"{simulator}: {tally.frames} frames equal, {rate:.0f} thousand clocks a second")
    return tally


def some_of_each(rendered: Sequence[Shot], photos: Sequence[Shot], count: int) -> list[Shot]:
    """`count` shots, in turn from one and the other as far as they go."""
    turns = zip_longest(rendered, photos)
    return [shot for turn in turns for shot in turn if shot is not None][:count]


def state_of_sources() -> list[int]:
    """When each source of landing_core was last changed."""
    return [source.stat().st_mtime_ns for source in landing_core_sources()]


def leave_results(figure: str, detail: dict[str, object], mismatches: Sequence[Mismatch]) -> None:
    """One result a core; after a difference none has passed, because no core was seen to the end."""
    for core in CORES:
        own = [mismatch.says for mismatch in mismatches if mismatch.core == core]
        if mismatches and not own:
            own = [f"not compared to the end: {mismatches[0].core} differs"]
        leave(core, CHECK, not mismatches, "; ".join(own) or figure, detail)


def check(
    rendered: Sequence[Shot], photos: Sequence[Shot], in_icarus: int, tell: Callable[[str], None] = print
) -> list[Mismatch]:
    """Compare, and leave the results.

    Args:
        rendered: rendered frames.
        photos: photographed frames.
        in_icarus: how many of them, some of each, also go through Icarus; it runs beside the verilated model.
        tell: is told in one line how far the check is.

    Returns:
        All differences found: at most one from each simulator, and one if no frame showed a single object.

    Raises:
        UserError: there is no frame, a tool is missing, or a source changed meanwhile.
    """
    shots = [*rendered, *photos]
    if not shots or not 0 <= in_icarus <= len(shots):
        raise UserError(f"{in_icarus} of {len(shots)} frames cannot be shown; give frames, and at most all to Icarus.")
    sources = state_of_sources()
    some = some_of_each(rendered, photos, in_icarus)
    figure = f"{len(rendered)} rendered + {len(photos)} photos, {in_icarus} in Icarus"
    tell(figure + ("" if photos else "; photos were not given"))
    # Icarus takes minutes a frame, so none is shown twice there, and the first one has no thresholds.
    with ThreadPoolExecutor(max_workers=1) as beside:
        other = beside.submit(run, "Icarus", [(some, len(some))] if some else [], OUTPUT / "icarus", icarus, tell)
        tallies = {
            "verilator": run("Verilator", batches(shots), OUTPUT / "verilator", verilated, tell),
            "icarus": other.result(),
        }
    if state_of_sources() != sources:
        raise UserError("a source of landing_core was changed during the run, so it counts for nothing; run it again.")
    mismatches = [tally.mismatch for tally in tallies.values() if tally.mismatch]
    if not mismatches and not tallies["verilator"].objects:
        mismatches = [Mismatch(WHOLE, "no frame showed an object, so nothing was compared behind the thresholds")]
    detail = {name: asdict(tally) for name, tally in tallies.items()}
    leave_results(figure, {**detail, "shots": [shot.name for shot in shots]}, mismatches)
    return mismatches


def main() -> int:
    """Entry point of `make frames`."""
    parser = ArgumentParser(prog="python -m sim.full_frames", description=__doc__)
    parser.add_argument("--photos", nargs="*", default=[], metavar="FOLDER", help="folders of 1280x720 pictures")
    parser.add_argument("--rendered", type=int, default=20, help="how many rendered views (default 20)")
    parser.add_argument("--icarus", type=int, default=3, help="how many frames also go through Icarus (default 3)")
    options = parser.parse_args()
    if options.rendered < 0:
        raise UserError(f"{options.rendered} rendered views cannot be made; give 0 or more.")
    photos = photo_shots(options.photos)
    mismatches = check(rendered_shots(options.rendered), photos, options.icarus, lambda line: print(line, flush=True))
    for mismatch in mismatches:
        print(f"touchdown: {mismatch.core} differs from its golden model: {mismatch.says}.", file=sys.stderr)
    if not mismatches:
        print("All streams and records equal the golden models.")
    return 1 if mismatches else 0


if __name__ == "__main__":
    run_main(main)
