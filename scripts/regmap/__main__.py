# SPDX-License-Identifier: Apache-2.0
"""`python -m scripts.regmap [--out DIR]`: writes every generated file, below DIR (the project root unless told)."""

from pathlib import Path

from scripts.errors import ArgumentParser, run_main
from scripts.regmap.generate import write_all

ROOT = Path(__file__).resolve().parents[2]


def main() -> None:
    """Generate all files and name them."""
    parser = ArgumentParser(prog="python -m scripts.regmap", description=__doc__)
    parser.add_argument("--out", type=Path, default=ROOT, help="folder that stands for the project root")
    for path in write_all(ROOT, parser.parse_args().out):
        print(path.relative_to(ROOT) if path.is_relative_to(ROOT) else path)


run_main(main)
