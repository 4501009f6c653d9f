# SPDX-License-Identifier: Apache-2.0
"""Vectors hold what the golden models say, in every form."""

import dataclasses
import json
from pathlib import Path

import cv2
import numpy as np
import pytest

from golden.chain import Settings, run_chain
from golden.gaussian5x5 import gaussian5x5
from golden.generated.landing_regs import OBJECT_DTYPE
from golden.threshold_apply import threshold_apply
from scripts.errors import UserError
from scripts.frames import FrameSet, open_frames
from scripts.vectors import CORES, hex_lines, main, stages_of, write_vectors

ROOT = Path(__file__).resolve().parent.parent


@pytest.fixture(scope="module")
def clip() -> FrameSet:
    """Two small frames, as a clip."""
    random = np.random.default_rng(1)
    images = [cv2.resize(random.integers(0, 256, (9, 16, 3), np.uint8), (160, 140)) for _ in range(2)]
    return FrameSet("test", ("a.png", "b.png"), True, (None, None), None, lambda: iter(images))


@pytest.mark.parametrize("core", CORES)
def test_every_form_holds_the_same(core: str, clip: FrameSet, tmp_path: Path) -> None:
    folders = write_vectors(core, clip, tmp_path)
    assert [folder.relative_to(tmp_path).as_posix() for folder in folders] == [f"{core}/a", f"{core}/b"]
    for folder in folders:
        metadata = json.loads((folder / "metadata.json").read_text())
        assert (metadata["core"], metadata["width"], metadata["height"]) == (core, 160, 140)
        expected = {f"in_{name}" for name in CORES[core].inputs} | {f"out_{name}" for name in CORES[core].outputs}
        assert set(metadata["streams"]) == expected
        for prefix, stream in metadata["streams"].items():
            array = np.load(folder / f"{prefix}.npy")
            lines = (folder / f"{prefix}.hex").read_text().split()
            assert len(lines) == stream["beats"]
            assert all(len(line) == max(stream["bits"] // 4, 1) for line in lines)
            if f"{prefix}.png" in stream["files"]:
                picture = cv2.imread(str(folder / f"{prefix}.png"), cv2.IMREAD_UNCHANGED)
                beats = [int(line, 16) for line in lines]
                if stream["bits"] == 24:
                    packed = picture[..., ::-1].astype(int) @ (1 << 16, 1 << 8, 1)
                    assert packed.ravel().tolist() == beats
                    assert np.array_equal(picture[..., ::-1], array)
                else:
                    scale = 255 if stream["bits"] == 1 else 1
                    assert picture.ravel().tolist() == [scale * beat for beat in beats]
                    assert np.array_equal(picture, array * scale)


def test_outputs_follow_from_inputs(clip: FrameSet, tmp_path: Path) -> None:
    for folder in write_vectors("gaussian5x5", clip, tmp_path):
        gray, smooth = (np.load(folder / f"{name}.npy") for name in ("in_gray", "out_smooth"))
        assert np.array_equal(gaussian5x5(gray), smooth)
    for folder in write_vectors("threshold_apply", clip, tmp_path):
        names = ("in_smooth", "in_stat_before", "out_binary")
        smooth, stats, binary = (np.load(folder / f"{name}.npy") for name in names)
        assert np.array_equal(threshold_apply(smooth, (stats & 0xFFFF).astype(np.uint16), dark_is_one=True), binary)


def test_thresholds_come_from_the_frame_before_in_a_clip_only(clip: FrameSet) -> None:
    settings = Settings()
    own = [run_chain(image, None, settings).stats.threshold for image in clip.open()]
    assert not np.array_equal(own[0], own[1])
    used = [stages.stats_before.threshold for stages in stages_of(clip, settings)]
    assert np.array_equal(used, [own[0], own[0]])
    pictures = dataclasses.replace(clip, sequential=False)
    assert np.array_equal([stages.stats_before.threshold for stages in stages_of(pictures, settings)], own)


def test_hex_of_an_object_is_the_number_on_the_stream() -> None:
    objects = np.zeros(2, OBJECT_DTYPE)
    objects[0]["area"] = 0x12345678
    objects[1]["sum_x"] = 1
    first, second = (int(line, 16) for line in hex_lines(objects, 512).split())
    assert first == 0x12345678
    assert second == 1 << (8 * OBJECT_DTYPE.fields["sum_x"][1])
    assert hex_lines(objects[:0], 512) == ""


def test_unknown_core(clip: FrameSet, tmp_path: Path) -> None:
    with pytest.raises(UserError, match=r"CORE=lidar has no vectors; give CORE= one of rgb2gray, .*ccl"):
        write_vectors("lidar", clip, tmp_path)
    with pytest.raises(UserError, match="no core was named"):
        write_vectors("", clip, tmp_path)


def test_folder_that_cannot_be_made(clip: FrameSet, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(UserError, match="cannot be written"):
        write_vectors("ccl", clip, tmp_path / "file")


def test_known_cores_exist() -> None:
    assert all((ROOT / "rtl" / core / f"{core}.v").is_file() for core in CORES)


def test_command_line_takes_recorded_frames(tmp_path: Path) -> None:
    assert cv2.imwrite(str(tmp_path / "photo.png"), np.full((720, 1280, 3), (1, 2, 3), np.uint8))
    main(["--core", "rgb2gray", "--frames", str(tmp_path / "photo.png"), "--out", str(tmp_path / "v")])
    folder = tmp_path / "v" / "rgb2gray" / "photo"
    assert (folder / "in_rgb.hex").read_text().startswith("030201\n")
    assert np.load(folder / "out_gray.npy").shape == (720, 1280)


def test_names_that_differ_only_in_suffix_stay_apart(tmp_path: Path) -> None:
    for name in ("a.png", "a.jpg", "b.png"):
        assert cv2.imwrite(str(tmp_path / name), np.zeros((720, 1280, 3), np.uint8))
    assert open_frames(str(tmp_path)).labels == ("a_jpg", "a_png", "b")
