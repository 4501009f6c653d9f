# SPDX-License-Identifier: Apache-2.0
"""The kept corpora of the fuzz targets under the sanitizers, and what belongs to `make fuzz`."""

import re
import subprocess
from pathlib import Path

import pytest

from firmware.library import BUILD, make
from scripts import fuzz, fuzz_corpus, fuzz_seeds
from scripts.errors import UserError

CORPUS_BYTES_MAX = 1_000_000


@pytest.fixture(scope="module", autouse=True)
def _replay() -> None:
    make(*(str(BUILD / f"replay_{target}") for target in fuzz.TARGETS))


def replay(target: str, path: Path) -> subprocess.CompletedProcess[str]:
    """Give a packed corpus to a target."""
    return subprocess.run([BUILD / f"replay_{target}", path], capture_output=True, text=True, check=False)


@pytest.mark.parametrize("target", fuzz.TARGETS)
def test_corpus_is_replayed(target: str) -> None:
    """Every kept input passes, and none is left out. Replay: build/firmware/replay_<target> <corpus>."""
    path = fuzz_corpus.corpus_path(target)
    inputs = fuzz_corpus.inputs_of(path.read_bytes())
    assert len(inputs) > 100
    assert max(map(len, inputs)) <= fuzz.TARGETS[target]
    result = replay(target, path)
    assert result.returncode == 0, result.stderr
    assert re.match(rf"{len(inputs)} inputs of ", result.stdout), result.stdout


@pytest.mark.parametrize("target", ["record", "loop"])
def test_seeds_are_replayed(target: str, tmp_path: Path) -> None:
    """Whole landings, torn records and what was once found."""
    inputs = fuzz_seeds.seeds(target)
    assert inputs
    path = tmp_path / "seeds"
    path.write_bytes(fuzz_corpus.packed_of(inputs))
    result = replay(target, path)
    assert result.returncode == 0, result.stderr
    assert result.stdout.startswith(f"{len(inputs)} inputs of "), result.stdout


def test_corpora_are_small() -> None:
    assert sum(fuzz_corpus.corpus_path(target).stat().st_size for target in fuzz.TARGETS) < CORPUS_BYTES_MAX


@pytest.mark.parametrize("packed", [b"\x05\x00\x00\x00abc", b"\x00\x00\x01\x00", b"\x01"])
def test_cut_off_corpus_is_refused(packed: bytes, tmp_path: Path) -> None:
    path = tmp_path / "packed"
    path.write_bytes(packed)
    result = replay("parameters", path)
    assert result.returncode != 0
    assert "is no packed corpus" in result.stderr
    with pytest.raises(UserError, match="ends within an input"):
        fuzz_corpus.inputs_of(packed)


def test_packed_is_unpacked(tmp_path: Path) -> None:
    inputs = [b"", b"\x00", bytes(range(256))]
    folder, again = tmp_path / "a", tmp_path / "b"
    folder.mkdir()
    again.mkdir()
    for index, data in enumerate(inputs):
        (folder / str(index)).write_bytes(data)
    assert fuzz_corpus.pack(folder, tmp_path / "packed") == 3
    assert fuzz_corpus.inputs_of((tmp_path / "packed").read_bytes()) == inputs
    assert fuzz_corpus.unpack(tmp_path / "packed", again) == 3
    assert sorted(file.read_bytes() for file in again.iterdir()) == inputs


def test_numbers_of_a_log() -> None:
    log = "#12\tNEW    cov: 5 ft: 7 corp: 2/3b\n#99\tDONE   cov: 6 ft: 9 corp: 2/3b\n"
    assert fuzz.numbers_of(log) == (99, 6, 9)
    assert fuzz.numbers_of(log + "stat::number_of_executed_units: 101\n") == (101, 6, 9)
    assert fuzz.numbers_of("") == (0, 0, 0)


@pytest.mark.parametrize(
    ("options", "words"),
    [(["--target", "nonsense"], "no fuzz target nonsense"), (["--runs", "-1"], "from 0 up")],
)
def test_a_mistake_is_one_sentence(options: list[str], words: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.argv", ["fuzz", *options])
    with pytest.raises(UserError, match=words):
        fuzz.main()
