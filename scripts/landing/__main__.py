# SPDX-License-Identifier: Apache-2.0
"""`python -m scripts.landing [--out DIR]`: writes every file generated from the landing's table, below DIR."""

from pathlib import Path

from scripts.errors import ArgumentParser, run_main
from scripts.landing.generate import write_all

ROOT = Path(__file__).resolve().parents[2]


def main() -> None:
    """Generate all files and name them."""
    parser = ArgumentParser(prog="python -m scripts.landing", description=__doc__)
    parser.add_argument("--out", type=Path, default=ROOT, help="folder that stands for the project root")
    for path in write_all(ROOT, parser.parse_args().out):
        print(path.relative_to(ROOT) if path.is_relative_to(ROOT) else path)


run_main(main)
