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
from dataclasses import dataclass, replace
from itertools import zip_longest
from pathlib import Path

import numpy as np

from scripts.errors import ArgumentParser, UserError, run_main
from scripts.frames import open_frames, read_picture
from sim.compare_stages import Simulate, StageMismatchError, compare, verilated
from sim.cosim.build import need
from sim.frames_result import (
    CORE_OF_STAGE,
    ICARUS,
    LEAST_IN_ICARUS,
    LEAST_RENDERED,
    OUTPUT,
    VERILATOR,
    WHOLE,
    Mismatch,
    Tally,
    digest_of_sources,
    keep,
    sum_up,
)
from sim.icarus.run import simulate as icarus
from sim.views import views

BATCH = 8
"""Frames a run that count: the streams of each take 17 MB on disk and again in memory."""


@dataclass(frozen=True)
class Shot:
    """One frame: what it is, for a person, and how to get its pixels."""

    name: str
    image: Callable[[], np.ndarray]
    photo: bool = False


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
            shots.append(Shot(f"photo {path}", lambda path=path: read_picture(path), photo=True))
    return shots


def batches(shots: Sequence[Shot], size: int = BATCH) -> Iterator[tuple[list[Shot], list[Shot]]]:
    """Runs of at most `size` frames that count: what is shown, and which of it counts.

    The first frame of a run has no thresholds: all of its binary stages are empty. So each run starts with a frame that
    does not count, the last one of the run before, and of the first run the last of all.
    """
    for start in range(0, len(shots), size):
        some = shots[start : start + size]
        yield [shots[start - 1], *some], some


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
    runs: Iterable[tuple[Sequence[Shot], Sequence[Shot]]],
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
        photos = sum(shot.photo for shot in counted)
        tally = tally.plus(len(counted) - photos, photos, report)
        rate = tally.clocks / tally.seconds / 1000
        tell(f"{simulator}: {tally.frames} frames equal, {rate:.0f} thousand clocks a second")
    return tally


def some_of_each(rendered: Sequence[Shot], photos: Sequence[Shot], count: int) -> list[Shot]:
    """`count` shots, in turn from one and the other as far as they go."""
    turns = zip_longest(rendered, photos)
    return [shot for turn in turns for shot in turn if shot is not None][:count]


def check(
    rendered: Sequence[Shot],
    photos: Sequence[Shot],
    in_icarus: int,
    only: str | None = None,
    tell: Callable[[str], None] = print,
) -> list[Mismatch]:
    """Compare, and leave the results.

    Args:
        rendered: rendered frames.
        photos: photographed frames.
        in_icarus: how many of them, some of each, also go through Icarus; it runs beside the verilated model.
        only: run one simulator; what the other one last gave for the same sources still counts.
        tell: is told in one line how far the check is.

    Returns:
        What is wrong: at most one difference from each simulator; nothing if all passed.

    Raises:
        UserError: there is no frame, a tool is missing, or a source changed meanwhile.
    """
    shots = [*rendered, *photos]
    if not shots or not 0 <= in_icarus <= len(shots):
        raise UserError(f"{in_icarus} of {len(shots)} frames cannot be shown; give frames, and at most all to Icarus.")
    sources = digest_of_sources()
    some = [] if only == VERILATOR else some_of_each(rendered, photos, in_icarus)
    most = [] if only == ICARUS else shots
    # Said now, not after the minutes of the other one.
    for tool in ("iverilog", "vvp") if some else ():
        need(tool)
    tell(
        f"Verilator: {len(most)} frames, Icarus: {len(some)}; {len(rendered)} are rendered, {len(photos)} are photos"
        + ("" if photos else ": photos were not given")
    )

    def finish(simulator: str, tally: Tally) -> list[Mismatch]:
        if digest_of_sources() != sources:
            raise UserError("a source of landing_core was changed during the run, so it counts for nothing; repeat it.")
        keep(simulator, tally, sources, OUTPUT)
        return sum_up(OUTPUT)

    # Icarus takes minutes a frame, so none is shown twice there, and the first one has no thresholds.
    with ThreadPoolExecutor(max_workers=1) as beside:
        other = beside.submit(run, "Icarus", [(some, some)], OUTPUT / ICARUS, icarus, tell) if some else None
        if most:
            finish(VERILATOR, run("Verilator", batches(most), OUTPUT / VERILATOR, verilated, tell))
        if other:
            finish(ICARUS, other.result())
    return sum_up(OUTPUT)


def main() -> int:
    """Entry point of `make frames`."""
    parser = ArgumentParser(prog="python -m sim.full_frames", description=__doc__)
    parser.add_argument("--photos", nargs="*", default=[], metavar="FOLDER", help="folders of 1280x720 pictures")
    parser.add_argument("--rendered", type=int, default=LEAST_RENDERED, help="rendered views (default %(default)s)")
    parser.add_argument("--icarus", type=int, default=LEAST_IN_ICARUS, help="frames for Icarus (default %(default)s)")
    parser.add_argument("--only", choices=(VERILATOR, ICARUS), help="run one simulator; the other's last result counts")
    options = parser.parse_args()
    if options.rendered < 0:
        raise UserError(f"{options.rendered} rendered views cannot be made; give 0 or more.")
    rendered, photos = rendered_shots(options.rendered), photo_shots(options.photos)
    mismatches = check(rendered, photos, options.icarus, options.only, lambda line: print(line, flush=True))
    for mismatch in mismatches:
        print(f"touchdown: whole frames, {mismatch.core}: {mismatch.says}.", file=sys.stderr)
    if not mismatches:
        print("All streams and records equal the golden models.")
    return 1 if mismatches else 0


if __name__ == "__main__":
    run_main(main)
