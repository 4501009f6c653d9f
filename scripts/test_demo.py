# SPDX-License-Identifier: Apache-2.0
"""The demo against a run made up here: messages packed by pymavlink, records laid out from the truth."""

import dataclasses
import html.parser
import re
from collections.abc import Callable, Iterable
from pathlib import Path

import cv2
import numpy as np
import pytest
from pymavlink.dialects.v20 import common

from golden import pad_geometry as pad
from golden.generated.landing_regs import RECORD_DTYPE
from scripts import demo as demo_module
from scripts.demo import demo, main
from scripts.demo_decode import decode, pad_report
from scripts.demo_draw import annotate, name_shapes
from scripts.demo_results import Pad, Row, collect, showings
from scripts.demo_table import table
from scripts.errors import UserError
from scripts.frames import CLIP_FRAMES, FrameSet, open_frames
from scripts.report_chart import Series, chart
from sim.cosim.result import CosimResult, Frame, Uart
from sim.world.camera import Camera
from sim.world.clip import demo_clip
from sim.world.pose import Pose, Truth, project_pad

BYTE_NS = 10_851
PERIOD_NS = 16_667_000
LATENCY_NS = 900_000
SHIFT_PX = 0.25


class Wire:
    """A UART that packs messages and counts time by the byte."""

    def __init__(self) -> None:
        self.mav = common.MAVLink(None, srcSystem=1, srcComponent=191)
        self.data = b""
        self.times: list[int] = []

    def send(self, message: common.MAVLink_message, start_ns: int) -> None:
        """Pack a message whose first byte starts at `start_ns`."""
        packed = message.pack(self.mav)
        self.mav.seq = (self.mav.seq + 1) % 256
        self.data += packed
        self.times += [start_ns + BYTE_NS * (index + 1) for index in range(len(packed))]

    def uart(self) -> Uart:
        """What the co-simulation would have logged."""
        times = np.array(self.times, np.int64)
        return Uart(self.data, times - BYTE_NS, times)


def pad_message(values: list[float], time_us: int) -> common.MAVLink_message:
    """As the firmware sends it to the ground station."""
    return common.MAVLink_debug_float_array_message(time_us, b"PAD", 1, values + [0.0] * (58 - len(values)))


def target_message(truth: Truth, time_us: int) -> common.MAVLink_message:
    """As the firmware sends it to the autopilot."""
    angles = np.arctan2([truth.right_m, -truth.forward_m], truth.altitude_m)
    distance = float(np.linalg.norm([truth.right_m, truth.forward_m, truth.altitude_m]))
    return common.MAVLink_landing_target_message(time_us, 0, 12, *angles.tolist(), distance, 0.1, 0.1)


def shape_objects(pose: Pose) -> list[dict[str, int]]:
    """Area, box and sums of the pad's shapes, from their projected outlines, and of a stray object before them."""
    turn = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    corners = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
    outlines = [
        pad.RING_OUTER_RADIUS_MM * circle,
        pad.SQUARE_SIDE_MM * corners + (pad.SQUARE_CENTRE_X_MM, pad.SQUARE_CENTRE_Y_MM),
        corners * (pad.RECTANGLE_WIDTH_MM, pad.RECTANGLE_HEIGHT_MM)
        + (pad.RECTANGLE_CENTRE_X_MM, pad.RECTANGLE_CENTRE_Y_MM),
        pad.SMALL_RING_OUTER_RADIUS_MM * circle,
    ]
    polygons = [np.array([[20, 30], [60, 30], [60, 50], [20, 50]])]
    polygons += [project_pad(Camera(), pose, outline) for outline in outlines]
    objects = []
    for polygon in polygons:
        low, high = np.rint(polygon.min(axis=0)).astype(int), np.rint(polygon.max(axis=0)).astype(int)
        sums = np.rint(100 * polygon.mean(axis=0)).astype(int)
        objects.append(
            {
                "area": 100,
                "box_min_x": low[0],
                "box_min_y": low[1],
                "box_max_x": high[0],
                "box_max_y": high[1],
                "sum_x": sums[0],
                "sum_y": sums[1],
            }
        )
    return objects


def record_of(number: int, time_us: int, pose: Pose | None) -> np.void:
    """A result record."""
    record = np.zeros((), RECORD_DTYPE)
    record["header"]["frame_number"] = number
    record["header"]["start_time_us"] = time_us
    objects = shape_objects(pose) if pose else []
    record["header"]["object_count"] = len(objects)
    for index, values in enumerate(objects):
        for name, value in values.items():
            record["objects"][index][name] = value
    return record[()]


def made_up_run(blind: Iterable[int] = ()) -> Callable[..., CosimResult]:
    """A runner that sees the pad of the rendered clip everywhere but in the `blind` showings."""

    def run(images: Iterable[np.ndarray], altitudes_mm: list[int], **options: object) -> CosimResult:
        repeat = int(options["repeat"])
        clip = demo_clip(CLIP_FRAMES)
        autopilot, ground, frames = Wire(), Wire(), []
        showing = 0
        for image_index, (image, altitude) in enumerate(zip(images, altitudes_mm, strict=True)):
            assert image.shape == (720, 1280, 3)
            for _ in range(repeat):
                scene = clip[min(max(image_index - 1, 0), len(clip) - 1)]
                first = PERIOD_NS * (showing + 1)
                last = first + 15_000_000
                time_us = first // 1000
                sees = showing not in blind
                record = record_of(showing + 1, time_us, scene.pose if sees else None)
                truth = scene.truth
                values = [0.0, 0, 0, 0, altitude / 1000.0, 0, 0, showing + 1, 5 * sees, 0.0]
                if sees:
                    offsets = [truth.right_m, truth.forward_m]
                    values = [1.0, truth.x_px + SHIFT_PX, truth.y_px, truth.angle_deg, values[4], *offsets, *values[7:]]
                    message = target_message(truth, time_us)
                    length = len(message.pack(autopilot.mav))
                    autopilot.send(message, last + LATENCY_NS - BYTE_NS * length)
                ground.send(pad_message(values, time_us), last)
                frames.append(Frame(showing, first, last, record, last))
                showing += 1
        none = np.array([], np.int64)
        out_dir = Path(str(options["out_dir"]))
        return CosimResult(frames, autopilot.uart(), ground.uart(), none, PERIOD_NS * showing, 1.5, out_dir)

    return run


@pytest.fixture(scope="module")
def clip() -> FrameSet:
    """The bundled clip, rendered once."""
    frames = open_frames(None)
    images = list(frames.open())
    return dataclasses.replace(frames, open=lambda: iter(images))


def altitudes(frames: FrameSet) -> list[float]:
    return [truth.altitude_m for truth in frames.truths if truth]


def test_clip_is_primed_and_every_frame_reported(
    clip: FrameSet, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rows = demo(clip, altitudes(clip), "qemu", tmp_path, made_up_run(blind=[0]))
    assert [row.name for row in rows] == list(clip.names)
    for row, truth in zip(rows, clip.truths, strict=True):
        assert row.pad is not None
        assert truth is not None
        # The showing that counts is this frame's own, not the one before.
        assert row.pad.y_px == pytest.approx(truth.y_px, abs=1e-3)
        assert row.error_px == pytest.approx(SHIFT_PX, abs=1e-3)
        assert row.error_deg == pytest.approx(0, abs=1e-4)
        assert row.error_m == pytest.approx(0, abs=1e-5)
        assert row.latency_us == pytest.approx(LATENCY_NS / 1000)
    output = capsys.readouterr().out
    assert f"Pad found in {CLIP_FRAMES} of {CLIP_FRAMES} frames; {CLIP_FRAMES + 1} frames shown" in output
    assert "LANDING_TARGET #0" in output
    pictures = sorted(path.name for path in tmp_path.glob("*.png"))
    assert pictures == [f"{name}.png" for name in clip.names]
    assert cv2.imread(str(tmp_path / pictures[0])).shape == (720, 1280, 3)


def test_frame_without_a_pad(clip: FrameSet, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = demo(clip, altitudes(clip), "host", tmp_path, made_up_run(blind=[0, 2]))
    assert [row.name for row in rows if row.pad is None] == ["0001"]
    assert rows[1].target is None
    assert rows[1].latency_us is None
    line = next(line for line in capsys.readouterr().out.splitlines() if line.startswith("0001"))
    assert line.split()[1:3] == ["no", "pad"]
    assert "LANDING_TARGET" not in line
    assert "no pad" in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_pictures_are_shown_twice_and_the_second_time_counts(tmp_path: Path) -> None:
    folder = tmp_path / "frames"
    folder.mkdir()
    for name in ("a.png", "b.png"):
        cv2.imwrite(str(folder / name), np.full((720, 1280, 3), 100, np.uint8))
    frames = open_frames(str(folder))
    assert showings(frames) == (2, [1, 3])
    rows = demo(frames, [1.0, 2.0], "qemu", tmp_path / "out", made_up_run(blind=[0, 2]))
    assert [int(row.record["header"]["frame_number"]) for row in rows] == [2, 4]
    assert all(row.pad for row in rows)
    assert all(row.error_px is None for row in rows)
    assert "error" not in table(rows)


def test_pictures_of_an_earlier_run_go(clip: FrameSet, tmp_path: Path) -> None:
    (tmp_path / "old.png").write_bytes(b"")
    demo(clip, altitudes(clip), "host", tmp_path, made_up_run())
    assert not (tmp_path / "old.png").exists()


def test_missing_record_or_message_fails_the_run(clip: FrameSet) -> None:
    result = made_up_run()(clip.open(), [1000] * CLIP_FRAMES, repeat=1, out_dir=Path())
    counted = list(range(CLIP_FRAMES))
    autopilot = decode(result.uart0.data, result.uart0.done_ns)
    ground = decode(result.uart1.data, result.uart1.done_ns)
    frames = result.frames
    torn = [*frames[:-1], Frame(frames[-1].index, 0, 0, None, None)]
    with pytest.raises(UserError, match=f"no result record for frame {CLIP_FRAMES - 1:04d}"):
        collect(clip, counted, torn, autopilot, ground)
    with pytest.raises(UserError, match="no PAD message for frame 0000"):
        collect(clip, counted, frames, autopilot, decode(b"", []))
    with pytest.raises(UserError, match="disagree about frame 0000"):
        collect(clip, counted, frames, decode(b"", []), ground)
    with pytest.raises(UserError, match="was not shown"):
        collect(clip, counted, frames[:-1], autopilot, ground)


def test_decoder_counts_noise_and_losses() -> None:
    wire = Wire()
    for index in range(5):
        wire.send(common.MAVLink_heartbeat_message(18, 8, 0, 0, 4, 3), 1_000_000 * index)
    length = len(wire.data) // 5
    # Noise before the first message, and the third message missing.
    data = b"\x00\x11\x22" + wire.data[: 2 * length] + wire.data[3 * length :]
    times = [0, 0, 0, *wire.times[: 2 * length], *wire.times[3 * length :]]
    line = decode(data, times)
    assert [message.kind for message in line.messages] == ["HEARTBEAT"] * 4
    assert [message.sequence for message in line.messages] == [0, 1, 3, 4]
    assert line.messages[1].done_ns == wire.times[2 * length - 1]
    assert (line.bad_bytes, line.lost) == (3, 1)


def test_decoder_rejects_a_corrupted_message() -> None:
    wire = Wire()
    for index in range(3):
        wire.send(target_message(demo_clip(2)[0].truth, 1000 * index), 0)
    data = bytearray(wire.data)
    data[len(data) // 3 + 20] ^= 0x40
    line = decode(bytes(data), wire.times)
    assert [message.fields["time_usec"] for message in line.of("LANDING_TARGET")] == [0, 2000]
    assert line.bad_bytes == len(data) // 3
    with pytest.raises(ValueError, match="times"):
        decode(b"\x00", [])


def test_only_the_pad_array_is_a_pad_report() -> None:
    wire = Wire()
    wire.send(common.MAVLink_debug_float_array_message(5, b"OTHER", 1, [1.0] * 58), 0)
    wire.send(pad_message([1.0, 10.0, 20.0, 30.0, 1.5, 0.1, 0.2, 7.0, 5.0, 0.0, 9.0], 6), 0)
    reports = [pad_report(message) for message in decode(wire.data, wire.times).messages]
    assert reports[0] is None
    assert reports[1] is not None
    assert (reports[1]["angle_deg"], reports[1]["frame_number"]) == (30.0, 7.0)


def row_of(pose: Pose, truth: Truth, shift: float = 0.0) -> Row:
    """A row with the pad found at the truth, shifted to the right."""
    seen = Pad(truth.x_px + shift, truth.y_px, truth.angle_deg, truth.right_m, truth.forward_m)
    return Row("x", seen, truth.altitude_m, None, None, record_of(1, 1, pose), truth)


@pytest.mark.parametrize("scene", demo_clip(4), ids=["2.0m", "1.3m", "0.8m", "0.5m"])
def test_picture_names_the_shapes(scene: object) -> None:
    row = row_of(scene.pose, scene.truth)
    assert name_shapes(row) == {"ring": 1, "square": 2, "rectangle": 3, "small ring": 4}


def test_picture_marks_the_centre_where_it_is() -> None:
    scene = demo_clip(2)[1]
    gray = np.full((720, 1280, 3), 128, np.uint8)
    picture = annotate(gray, row_of(scene.pose, scene.truth, shift=60.0)).astype(int)
    x, y = round(scene.truth.x_px + 60), round(scene.truth.y_px)
    green = picture[..., 1] - picture[..., 0]
    assert green[y, x] > 100
    assert (gray == 128).all()
    assert annotate(gray, Row("x", None, None, None, None, record_of(1, 1, None), None)).shape == gray.shape


class _References(html.parser.HTMLParser):
    """Collects everything a page points at, and checks that elements close."""

    VOID = ("meta", "img")

    def __init__(self) -> None:
        super().__init__()
        self.references: list[str] = []
        self.open: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.references += [value or "" for name, value in attrs if name in ("src", "href")]
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Opens nothing."""

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def test_report_stands_alone(clip: FrameSet, tmp_path: Path) -> None:
    demo(clip, altitudes(clip), "qemu", tmp_path, made_up_run(blind=[3]))
    text = (tmp_path / "report.html").read_text(encoding="utf-8")
    page = _References()
    page.feed(text)
    assert page.open == []
    assert len(page.references) == CLIP_FRAMES
    assert all(reference.startswith("data:image/jpeg;base64,") for reference in page.references)
    assert not re.search(r"https?://|@import|url\(", text)
    assert text.count("<svg") == 3
    assert text.count("<tr") == CLIP_FRAMES + 1


def test_chart_keeps_to_its_frame_and_leaves_gaps() -> None:
    svg = chart("T", "m", list("abcde"), [Series("s", [1.0, 2.0, None, 3.0, 1.5], "primary")])
    assert svg.count("<polyline") == 2
    assert svg.count("<circle") == 4
    assert "<polyline" not in chart("T", "m", ["a", "b"], [Series("s", [1.0, 2.0], "primary")], joined=False)
    heights = [float(value) for value in re.findall(r"cy='([\d.]+)'", svg)]
    assert all(40 <= height <= 190 for height in heights)
    assert heights[2] < heights[1] < heights[3] < heights[0]
    for values in ([None], [0.0], [5.0], [1e-9], [-3.0]):
        assert chart("T", "m", ["a"], [Series("s", values, "primary")]).endswith("</svg>")


def test_command_line(clip: FrameSet, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[tuple] = []
    monkeypatch.setattr(demo_module, "demo", lambda *given: seen.append(given))
    main(["--out", str(tmp_path), "--firmware", "host", "--limit", "2", "--altitude", "3"])
    frames, heights, firmware, out_dir = seen[0]
    assert (len(frames.names), heights, firmware, out_dir) == (2, [3.0, 3.0], "host", tmp_path)
    with pytest.raises(UserError, match="does not exist"):
        main(["--frames", str(tmp_path / "none")])
    with pytest.raises(UserError, match=r"other.*qemu.*host"):
        main(["--firmware", "other"])
    assert len(clip.names) == CLIP_FRAMES


def test_folder_that_cannot_be_made(clip: FrameSet, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(UserError, match="cannot be made"):
        demo(clip, altitudes(clip), "qemu", tmp_path / "file" / "out", made_up_run())
