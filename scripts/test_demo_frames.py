# SPDX-License-Identifier: Apache-2.0
"""Every way in which frames and altitudes can be given, and every way in which that can go wrong."""

import itertools
import os
import re
from pathlib import Path

import cv2
import numpy as np
import pytest

from scripts.errors import UserError
from scripts.frames import CLIP_FRAMES, FrameSet, open_frames
from scripts.frames_altitude import altitudes_m


def picture(path: Path, width: int = 1280, height: int = 720, level: int = 90) -> Path:
    """A flat picture, reddish in RGB, so that swapped channels show."""
    path.parent.mkdir(parents=True, exist_ok=True)
    bgr = np.full((height, width, 3), (10, 20, level), np.uint8)
    assert cv2.imwrite(str(path), bgr)
    return path


def sentence(caught: pytest.ExceptionInfo[UserError]) -> str:
    """The message, which must be one line that ends as a sentence does."""
    text = str(caught.value)
    assert "\n" not in text
    assert text.endswith(".")
    return text


def video(path: Path, count: int, width: int = 1280, height: int = 720) -> Path:
    """A video whose frames get brighter."""
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 30, (width, height))
    assert writer.isOpened()
    for index in range(count):
        writer.write(np.full((height, width, 3), 40 + 40 * index, np.uint8))
    writer.release()
    return path


def test_clip() -> None:
    frames = open_frames(None)
    assert len(frames.names) == CLIP_FRAMES
    assert frames.sequential
    truths = [truth for truth in frames.truths if truth]
    assert altitudes_m(frames, None) == [truth.altitude_m for truth in truths]
    first = next(frames.open())
    assert first.shape == (720, 1280, 3)
    assert first.dtype == np.uint8


def test_limit() -> None:
    assert len(open_frames(None, 2).names) == 2
    with pytest.raises(UserError) as caught:
        open_frames(None, 0)
    assert "1 or more" in sentence(caught)


def test_folder_in_natural_order_and_in_rgb(tmp_path: Path) -> None:
    picture(tmp_path / "image_10.png", level=110)
    picture(tmp_path / "image_9.PNG", level=109)
    picture(tmp_path / "later.jpg", level=120)
    (tmp_path / "notes.txt").write_text("not a picture")
    frames = open_frames(str(tmp_path))
    assert frames.title == f"3 pictures of {tmp_path.name}"
    assert open_frames(str(tmp_path), 1).title == f"1 picture of {tmp_path.name}"
    assert frames.names == ("image_9.PNG", "image_10.png", "later.jpg")
    assert not frames.sequential
    assert [int(image[0, 0, 0]) for image in frames.open()][:2] == [109, 110]
    assert [int(image[0, 0, 0]) for image in frames.open()][:2] == [109, 110]


def test_one_picture(tmp_path: Path) -> None:
    frames = open_frames(str(picture(tmp_path / "one.png")))
    assert frames.names == ("one.png",)


def test_video(tmp_path: Path) -> None:
    path = video(tmp_path / "clip.avi", 3)
    frames = open_frames(str(path))
    assert frames.names == ("0000", "0001", "0002")
    assert frames.sequential
    levels = [image.mean() for image in frames.open()]
    assert all(b > a + 20 for a, b in itertools.pairwise(levels))
    assert len(open_frames(str(path), 2).names) == 2
    assert len(list(open_frames(str(path), 2).open())) == 2


def test_missing_path(tmp_path: Path) -> None:
    with pytest.raises(UserError) as caught:
        open_frames(str(tmp_path / "nowhere"))
    assert "nowhere does not exist" in sentence(caught)


def test_empty_folder(tmp_path: Path) -> None:
    with pytest.raises(UserError) as caught:
        open_frames(str(tmp_path))
    assert "no PNG or JPEG" in sentence(caught)


@pytest.mark.parametrize("size", [(640, 480), (720, 1280), (1281, 720)])
def test_wrong_size(tmp_path: Path, size: tuple[int, int]) -> None:
    picture(tmp_path / "good.png")
    picture(tmp_path / "odd.png", *size)
    with pytest.raises(UserError) as caught:
        open_frames(str(tmp_path))
    assert f"odd.png is {size[0]}x{size[1]}" in sentence(caught)


@pytest.mark.parametrize("content", [b"", b"\x89PNG\r\n\x1a\nbroken", b"text"])
def test_undecodable_picture(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "bad.png").write_bytes(content)
    with pytest.raises(UserError) as caught:
        open_frames(str(tmp_path))
    assert "bad.png cannot be decoded" in sentence(caught)


@pytest.mark.parametrize("kept", [0.3, 0.7, 0.999])
@pytest.mark.parametrize("kind", ["jpg", "png"])
def test_cut_off_picture(tmp_path: Path, capfd: pytest.CaptureFixture, kind: str, kept: float) -> None:
    """OpenCV would show the part that is there, and gray below, or complain in its own words."""
    picture(tmp_path / f"whole.{kind}")
    whole = (tmp_path / f"whole.{kind}").read_bytes()
    assert len(open_frames(str(tmp_path)).names) == 1
    (tmp_path / f"cut.{kind}").write_bytes(whole[: int(len(whole) * kept)])
    with pytest.raises(UserError) as caught:
        open_frames(str(tmp_path))
    assert f"cut.{kind} cannot be decoded" in sentence(caught)
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize(
    ("kind", "damage"),
    [("jpg", b"\xff\xd3"), ("jpg", b"\xff\xd9"), ("png", b"damage")],
    ids=["restart", "early end", "png"],
)
def test_picture_damaged_within(
    tmp_path: Path, capfd: pytest.CaptureFixture, grain: np.ndarray, kind: str, damage: bytes
) -> None:
    """Both ends are there."""
    path = tmp_path / f"whole.{kind}"
    assert cv2.imwrite(str(path), grain)
    whole = path.read_bytes()
    assert len(open_frames(str(tmp_path)).names) == 1
    middle = len(whole) // 2
    (tmp_path / f"hit.{kind}").write_bytes(whole[:middle] + damage + whole[middle + len(damage) :])
    with pytest.raises(UserError) as caught:
        open_frames(str(tmp_path))
    assert f"hit.{kind} cannot be decoded" in sentence(caught)
    assert capfd.readouterr().err == ""


def test_what_the_libraries_say_is_silent_only_meanwhile(tmp_path: Path, capfd: pytest.CaptureFixture) -> None:
    open_frames(str(picture(tmp_path / "one.jpg")))
    os.write(2, b"still here")
    assert capfd.readouterr().err == "still here"


@pytest.fixture
def grain() -> np.ndarray:
    """A picture with something in it everywhere, so that damage meets data."""
    small = np.random.default_rng(1).integers(0, 255, (72, 128, 3), np.uint8)
    return cv2.resize(small, (1280, 720))


@pytest.mark.parametrize(("name", "fourcc"), [("clip.avi", "MJPG"), ("clip.mkv", "mp4v")])
def test_video_that_is_cut_off(tmp_path: Path, grain: np.ndarray, name: str, fourcc: str) -> None:
    path = tmp_path / name
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*fourcc), 30, (1280, 720))
    for index in range(12):
        writer.write(np.roll(grain, 8 * index, 1))
    writer.release()
    assert len(open_frames(str(path)).names) == 12
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    with pytest.raises(UserError) as caught:
        open_frames(str(path))
    whole = re.search(rf"{name} is cut off or damaged: (\d+) of its 12 frames", sentence(caught))
    assert whole is not None
    assert len(open_frames(str(path), int(whole[1])).names) == int(whole[1])


def test_file_that_is_no_video(tmp_path: Path) -> None:
    (tmp_path / "clip.mp4").write_bytes(b"not a video")
    with pytest.raises(UserError) as caught:
        open_frames(str(tmp_path / "clip.mp4"))
    assert "OpenCV can play" in sentence(caught)


def test_video_without_frames(tmp_path: Path) -> None:
    with pytest.raises(UserError) as caught:
        open_frames(str(video(tmp_path / "none.avi", 0)))
    assert "none.avi" in sentence(caught)


def test_video_of_wrong_size(tmp_path: Path) -> None:
    with pytest.raises(UserError) as caught:
        open_frames(str(video(tmp_path / "small.avi", 2, 320, 240)))
    assert "frame 0 of" in sentence(caught)
    assert "320x240" in str(caught.value)


@pytest.fixture
def pair(tmp_path: Path) -> FrameSet:
    """Two pictures without altitudes."""
    picture(tmp_path / "frames" / "a.png")
    picture(tmp_path / "frames" / "b.png")
    return open_frames(str(tmp_path / "frames"))


def test_altitude_in_metres(pair: FrameSet) -> None:
    assert altitudes_m(pair, "1.25") == [1.25, 1.25]


def test_altitude_beside_the_frames(pair: FrameSet, tmp_path: Path) -> None:
    (tmp_path / "frames" / "altitude.csv").write_text("frame,altitude_m\na.png,1.5\nb.png,0.75\n")
    assert altitudes_m(pair, None) == [1.5, 0.75]
    (tmp_path / "other.csv").write_text("note, altitude_m, frame\n\nx, 3, B.png\ny, 2, a.png\n")
    assert altitudes_m(pair, str(tmp_path / "other.csv")) == [2.0, 3.0]


def test_altitude_of_a_video_by_number(tmp_path: Path) -> None:
    frames = open_frames(str(video(tmp_path / "v.avi", 2)))
    (tmp_path / "v.csv").write_text("frame,altitude_m\n0,2.5\n1,2.25\n")
    assert altitudes_m(frames, None) == [2.5, 2.25]


def test_no_altitude(pair: FrameSet) -> None:
    with pytest.raises(UserError) as caught:
        altitudes_m(pair, None)
    assert "ALTITUDE=metres" in sentence(caught)


def test_altitude_file_missing(pair: FrameSet, tmp_path: Path) -> None:
    with pytest.raises(UserError) as caught:
        altitudes_m(pair, str(tmp_path / "none.csv"))
    assert "none.csv does not exist" in sentence(caught)


def test_altitude_file_is_a_folder(pair: FrameSet, tmp_path: Path) -> None:
    with pytest.raises(UserError) as caught:
        altitudes_m(pair, str(tmp_path))
    assert sentence(caught) == f"{tmp_path} cannot be read: is a directory; give ALTITUDE as metres or as a CSV file."


@pytest.mark.parametrize("value", ["nan", "-1", "0", "inf", "40.1"])
def test_altitude_out_of_range(pair: FrameSet, tmp_path: Path, value: str) -> None:
    with pytest.raises(UserError) as caught:
        altitudes_m(pair, value)
    assert "above 0 and at most 40" in sentence(caught)
    path = tmp_path / "a.csv"
    path.write_text(f"frame,altitude_m\na.png,1\nb.png,{value}\n")
    with pytest.raises(UserError) as caught:
        altitudes_m(pair, str(path))
    assert sentence(caught).startswith(f"line 3 of {path}")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", "names the columns"),
        ("a.png,1\nb.png,2\n", "names the columns"),
        ("frame,altitude\na.png,1\n", "names the columns"),
        ("frame,altitude_m\na.png\n", "line 2"),
        ("frame,altitude_m\na.png,high\n", "'high'"),
        ("frame,altitude_m\na.png,1\na.png,2\nb.png,1\n", "second altitude for frame a.png"),
        ("frame,altitude_m\na.png,1\n", "no altitude for frame b.png"),
        ("frame,altitude_m\n", "a.png and 1 more"),
    ],
)
def test_malformed_altitude_file(pair: FrameSet, tmp_path: Path, text: str, expected: str) -> None:
    path = tmp_path / "a.csv"
    path.write_text(text)
    with pytest.raises(UserError) as caught:
        altitudes_m(pair, str(path))
    assert expected in sentence(caught)


def test_altitude_file_that_is_not_text(pair: FrameSet, tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_bytes(b"\xff\xfe\x00binary")
    with pytest.raises(UserError) as caught:
        altitudes_m(pair, str(path))
    assert "cannot be read as CSV" in sentence(caught)
