# SPDX-License-Identifier: Apache-2.0
"""The file for the memory of the board: its bytes, and what is said of a picture that cannot be one."""

import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest

from scripts.frames import HEIGHT, WIDTH
from tb.common.cores import ROOT


def run(*arguments: object) -> subprocess.CompletedProcess[str]:
    """Run the command from the project root."""
    command = [sys.executable, "-m", "scripts.stored_frame", *map(str, arguments)]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)


def picture(path: Path, width: int = WIDTH, height: int = HEIGHT) -> np.ndarray:
    """Write a random picture; its pixels, blue first."""
    bgr = np.random.default_rng(1).integers(0, 256, (height, width, 3), np.uint8)
    assert cv2.imwrite(str(path), bgr)
    return bgr


def test_a_picture_becomes_its_memory(tmp_path: Path) -> None:
    bgr = picture(tmp_path / "photo.png")
    result = run(tmp_path / "photo.png", "-o", tmp_path / "frame.bin")
    assert result.returncode == 0, result.stderr
    pixels = np.frombuffer((tmp_path / "frame.bin").read_bytes(), np.uint8).reshape(HEIGHT, WIDTH, 4)
    assert np.array_equal(pixels[..., :3], bgr)
    assert not pixels[..., 3].any()


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        ("missing", ("cannot be read", "check the file")),
        ("folder", ("cannot be read", "check the file")),
        ("empty", ("cannot be decoded", "replace it")),
        ("cut", ("cannot be decoded", "replace it")),
        ("text", ("cannot be decoded", "replace it")),
        ("size", ("640x480", "1280x720", "scale or crop it")),
        ("output", ("cannot be written", "-o")),
        ("no output", ("-o", "--help")),
    ],
)
def test_a_mistake_is_one_sentence(tmp_path: Path, spoil: str, words: tuple[str, ...]) -> None:
    source, target = tmp_path / "photo.jpg", tmp_path / "frame.bin"
    picture(source, *((640, 480) if spoil == "size" else ()))
    if spoil in ("missing", "folder"):
        source.unlink()
    if spoil == "folder":
        source.mkdir()
    if spoil == "cut":
        source.write_bytes(source.read_bytes()[:20000])
    if spoil in ("empty", "text"):
        source.write_text("" if spoil == "empty" else "no picture")
    if spoil == "output":
        target = tmp_path / "no" / "frame.bin"
    result = run(source, *(() if spoil == "no output" else ("-o", target)))
    assert result.returncode != 0
    (line,) = result.stderr.splitlines()
    assert line.startswith("touchdown: ")
    assert all(word in line for word in words), line
    assert not target.exists()
