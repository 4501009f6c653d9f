# SPDX-License-Identifier: Apache-2.0
"""Measures which lines, branches and toggles of a core its own tests reach: `make coverage [CORE=name]`.

All configs run in Verilator; their points are merged. A core passes when at least 95 per cent of its points that are
not waived are hit. The lines with missed points are printed.
"""

from pathlib import Path

from scripts.errors import ArgumentParser, UserError, run_main
from scripts.signoff import leave
from scripts.signoff_inputs import digest
from tb.common.cores import ROOT, Core, core_names, load_core
from tb.common.runner import check_simulator, default_seed, run_config
from tb.coverage.points import Point, folded, load_waivers, merge, missed, read_points, waive
from tb.mutation.plan import own_sources

GOAL = 0.95
WORK = ROOT / "build/coverage"
WAIVERS = Path(__file__).parent / "waivers.toml"


def measure(core: Core, reuse: bool) -> dict[Point, int]:
    """Run all configs and return the points of the core's own files.

    Raises:
        UserError: a test fails, or nothing was recorded.
    """
    parts = []
    for index in range(len(core.configs)):
        record = WORK / core.name / "verilator" / core.config_name(index) / "coverage.dat"
        if not (reuse and record.is_file()):
            record.unlink(missing_ok=True)
            result = run_config(
                core,
                "verilator",
                index,
                seed=default_seed(),
                output=WORK,
                build_args=("--coverage-line", "--coverage-toggle"),
            )
            if not result.passed:
                raise UserError(f"{core.name}, config {index}, fails, so it has no coverage: {result.summary}")
        parts.append(read_points(record.read_text(encoding="utf-8"), ROOT))
    own = {str(path.relative_to(ROOT)) for path in own_sources(core)}
    return {point: count for point, count in merge(parts).items() if point.file in own}


def lines_of(core: Core) -> dict[tuple[str, int], str]:
    """Return each line of the core's own files without its comment."""
    texts = {}
    for path in own_sources(core):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            texts[str(path.relative_to(ROOT)), number] = line.partition("//")[0].strip()
    return texts


def passes(hit: int, total: int) -> bool:
    """Return whether enough of the points are hit."""
    return total > 0 and hit >= GOAL * total


def run(core: Core, reuse: bool) -> bool:
    """Measure a core, print what it misses, leave its figures unless they are of an earlier run; whether it passes."""
    inputs = digest(core.name, "coverage")
    counts = measure(core, reuse)
    texts = lines_of(core)
    stay, waived = waive(core.name, missed(counts), texts, load_waivers(WAIVERS))
    for (file, line), names in folded(stay).items():
        print(f"{file}:{line}: {texts[file, line]}\n    missed: {' '.join(names)}")
    total = len(counts) - len(waived)
    hit = total - len(stay)
    passed = passes(hit, total)
    figure = f"{100 * hit / max(total, 1):.1f} % of {total} points, {len(waived)} waived"
    kinds = {}
    for kind in sorted({point.kind for point in counts}):
        points = [point for point in counts if point.kind == kind and point not in waived]
        kinds[kind] = {"hit": sum(counts[point] > 0 for point in points), "total": len(points)}
    detail = {
        "hit": hit,
        "total": total,
        "waived": len(waived),
        "kinds": kinds,
        "missed": [f"{point.file}:{point.line} {point.kind} {point.what}" for point in stay],
    }
    if not reuse:
        leave(core.name, "coverage", passed, figure, detail, inputs=inputs)
    print(f"{core.name}: {figure}", flush=True)
    return passed


def main() -> int:
    """Entry point of `make coverage`."""
    parser = ArgumentParser(prog="make coverage", description=__doc__)
    parser.add_argument("--core", default="", help="one core; all when left out")
    parser.add_argument("--reuse", action="store_true", help="read the records of an earlier run, and leave nothing")
    arguments = parser.parse_args()
    check_simulator("verilator")
    names = [arguments.core] if arguments.core else core_names()
    failed = [name for name in names if not run(load_core(name), arguments.reuse)]
    if failed:
        raise UserError(f"less than {GOAL:.0%} of the points are reached in {', '.join(failed)}; add tests or waivers.")
    return 0


if __name__ == "__main__":
    run_main(main)
