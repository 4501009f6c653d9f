# SPDX-License-Identifier: Apache-2.0
"""What autopilot and ground station receive, decoded by pymavlink, for pads painted by the renderer's geometry."""

import math
from collections.abc import Iterator

import cv2
import numpy as np
import pytest
from pymavlink.dialects.v20 import common as mavlink

from firmware.library import AUTOPILOT, GROUND, Firmware, make
from golden import result_writer
from golden.chain import Settings
from golden.generated.landing_regs import OBJECT_DTYPE
from sim.world.camera import Camera
from sim.world.pad import coverage
from sim.world.pose import Pose, camera_from_level, pad_to_level, truth_of

FLAG_RING, FLAG_LIDAR, FLAG_PAD, FLAG_IMPLAUSIBLE = 0x10, 0x40, 0x80, 0x100
HEADER = {
    "start_time_us": 123_456_789_012,
    "frame_number": 77,
    "frame_size_width": 1280,
    "frame_size_height": 720,
    "min_area": 30,
}


@pytest.fixture(scope="module", autouse=True)
def _library() -> None:
    make("host")


@pytest.fixture
def firmware() -> Iterator[Firmware]:
    yield Firmware()


def objects_of(mask: np.ndarray) -> np.ndarray:
    """Objects of a binary image, as the hardware would report them."""
    count, labels, stats, _ = cv2.connectedComponentsWithStats(mask.astype(np.uint8), connectivity=8)
    objects = np.zeros(count - 1, OBJECT_DTYPE)
    for index, (entry, box) in enumerate(zip(objects, stats[1:], strict=True), start=1):
        left, top, width, height, area = (int(value) for value in box)
        y, x = np.nonzero(labels[top : top + height, left : left + width] == index)
        x, y = x + left, y + top
        entry["area"] = area
        entry["box_min_x"], entry["box_min_y"] = left, top
        entry["box_max_x"], entry["box_max_y"] = left + width - 1, top + height - 1
        for name, values in (("x", x), ("y", y), ("xx", x * x), ("yy", y * y), ("xy", x * y)):
            entry[f"sum_{name}"] = values.sum()
    return objects


def record_of(pose: Pose, camera: Camera | None = None, **header: int) -> bytes:
    """Record of a pad without noise."""
    camera = camera or Camera()
    level = camera.rays().astype(np.float64) @ camera_from_level(pose)
    plane = level[..., :2] / level[..., 2:] * (1000.0 * pose.altitude_m)
    rotation, shift = pad_to_level(pose)
    pad = (plane - shift) @ rotation
    _, black = coverage(pad[..., 0], pad[..., 1])
    size = {"frame_size_width": camera.width, "frame_size_height": camera.height}
    return result_writer.record(HEADER | size | header, objects_of(black > 0.5))


def only(messages: list[mavlink.MAVLink_message], kind: str) -> mavlink.MAVLink_message:
    """The one message of a kind.

    Raises:
        AssertionError: there is none, or more than one.
    """
    found = [message for message in messages if message.get_type() == kind]
    assert len(found) == 1, f"{len(found)} {kind} among {[message.get_type() for message in messages]}"
    return found[0]


POSES = [
    pytest.param(Pose(1.0, right_m=0.3, forward_m=0.2, pad_yaw_deg=10), id="right ahead"),
    pytest.param(Pose(1.0, right_m=-0.3, forward_m=0.2, pad_yaw_deg=100), id="left ahead"),
    pytest.param(Pose(0.6, right_m=0.2, forward_m=-0.1, pad_yaw_deg=-170), id="right behind"),
    pytest.param(Pose(1.8, right_m=-0.5, forward_m=-0.4, pad_yaw_deg=-80), id="left behind"),
    pytest.param(Pose(0.3, pad_yaw_deg=45), id="close"),
]


@pytest.mark.parametrize("pose", POSES)
def test_landing_target_points_at_the_pad(firmware: Firmware, pose: Pose) -> None:
    """The renderer's camera and the firmware's are inverses: where the pad is, is where LANDING_TARGET points."""
    altitude_mm = round(1000 * pose.altitude_m)
    assert firmware.on_record(record_of(pose, altitude_valid=1, altitude_mm=altitude_mm)) == 0
    target = only(firmware.take(AUTOPILOT), "LANDING_TARGET")
    assert target.frame == mavlink.MAV_FRAME_BODY_FRD
    assert target.position_valid == 0
    assert target.time_usec == HEADER["start_time_us"]
    assert target.angle_x == pytest.approx(math.atan(pose.right_m / pose.altitude_m), abs=2e-3)
    assert target.angle_y == pytest.approx(-math.atan(pose.forward_m / pose.altitude_m), abs=2e-3)
    slant_m = math.hypot(pose.right_m, pose.forward_m, pose.altitude_m)
    assert target.distance == pytest.approx(slant_m, rel=0.02)
    assert (target.get_srcSystem(), target.get_srcComponent()) == (1, 191)


@pytest.mark.parametrize("pose", POSES)
def test_ground_station_sees_the_pad(firmware: Firmware, pose: Pose) -> None:
    record = record_of(pose, altitude_valid=1, altitude_mm=round(1000 * pose.altitude_m))
    assert firmware.on_record(record) == 0
    array = only(firmware.take(GROUND), "DEBUG_FLOAT_ARRAY")
    truth = truth_of(Camera(), pose)
    found, x, y, angle, altitude, right, forward, frame_number, object_count, flags, doubt, size_altitude = array.data[
        :12
    ]
    assert array.name == "PAD"
    assert array.time_usec == HEADER["start_time_us"]
    assert found == 1
    assert (x, y) == (pytest.approx(truth.x_px, abs=0.3), pytest.approx(truth.y_px, abs=0.3))
    assert math.remainder(angle - truth.angle_deg, 360) == pytest.approx(0, abs=0.5)
    assert altitude == pytest.approx(pose.altitude_m, rel=0.02)
    assert size_altitude == pytest.approx(pose.altitude_m, rel=0.02)
    assert (right, forward) == (pytest.approx(pose.right_m, abs=0.02), pytest.approx(pose.forward_m, abs=0.02))
    assert (frame_number, object_count) == (77, 4)
    assert int(flags) & (FLAG_RING | FLAG_LIDAR | FLAG_PAD) == FLAG_RING | FLAG_LIDAR | FLAG_PAD
    assert doubt < 0.5


def test_smaller_frame_is_the_same_camera(firmware: Firmware) -> None:
    pose = Pose(0.5, right_m=0.1, forward_m=0.05, pad_yaw_deg=30)
    assert firmware.on_record(record_of(pose, Camera().scaled(2))) == 0
    target = only(firmware.take(AUTOPILOT), "LANDING_TARGET")
    assert target.angle_x == pytest.approx(math.atan(0.2), abs=3e-3)
    assert target.angle_y == pytest.approx(-math.atan(0.1), abs=3e-3)


def test_attitude_of_the_autopilot_counts(firmware: Firmware) -> None:
    """It says how the pad must lie: a pad that fits without is believed with the true one, and refused with a wrong."""
    pose = Pose(0.6, right_m=0.1, pad_yaw_deg=30, roll_deg=12, pitch_deg=-8)
    roll, pitch = math.radians(pose.roll_deg), math.radians(pose.pitch_deg)
    for number, (told, found) in enumerate((((roll, pitch), 1), ((-roll, -pitch), 0)), start=1):
        firmware.attitude(*told)
        assert firmware.on_record(record_of(pose, frame_number=number)) == 0
        assert only(firmware.take(GROUND), "DEBUG_FLOAT_ARRAY").data[0] == found


def test_threshold_starts_as_the_golden_chain_has_it(firmware: Firmware) -> None:
    assert firmware.threshold == Settings().threshold_register


def test_no_pad_no_landing_target(firmware: Firmware) -> None:
    record = result_writer.record(HEADER | {"altitude_valid": 1, "altitude_mm": 2500}, np.zeros(0, OBJECT_DTYPE))
    firmware.take(GROUND)
    assert firmware.on_record(record) == 0
    assert firmware.take(AUTOPILOT) == []
    data = only(firmware.take(GROUND), "DEBUG_FLOAT_ARRAY").data
    assert list(data[:8]) == [0, 0, 0, 0, 2.5, 0, 0, 77]


def test_altitude_that_contradicts_the_pad_is_left_out(firmware: Firmware) -> None:
    assert firmware.on_record(record_of(Pose(1.0), altitude_valid=1, altitude_mm=2000)) == 0
    data = only(firmware.take(GROUND), "DEBUG_FLOAT_ARRAY").data
    assert data[4] == pytest.approx(1.0, rel=0.02)
    assert int(data[9]) & (FLAG_LIDAR | FLAG_IMPLAUSIBLE) == FLAG_IMPLAUSIBLE


def test_bad_record_is_refused(firmware: Firmware) -> None:
    record = bytearray(record_of(Pose(1.0)))
    assert firmware.on_record(bytes(record[:-1])) == -1
    record[2] ^= 1
    assert firmware.on_record(bytes(record)) == -2
    assert firmware.take(AUTOPILOT) == []


def test_rates_from_power_up(firmware: Firmware) -> None:
    """HEARTBEAT at 1 Hz on both links, DISTANCE_SENSOR at 20 Hz, both from the first moment."""
    for now_us in range(0, 3_000_000, 1000):
        firmware.tick(now_us, lidar_mm=1234)
    autopilot, ground = firmware.take(AUTOPILOT), firmware.take(GROUND)
    for messages in (autopilot, ground):
        beats = [message for message in messages if message.get_type() == "HEARTBEAT"]
        assert len(beats) == 3
        assert {(beat.type, beat.autopilot, beat.system_status) for beat in beats} == {(18, 8, 4)}
        sequence = [message.get_seq() for message in messages]
        assert sequence == [index % 256 for index in range(len(sequence))]
    distances = [message for message in autopilot if message.get_type() == "DISTANCE_SENSOR"]
    assert [message.time_boot_ms for message in distances] == list(range(0, 3000, 50))
    assert {(m.current_distance, m.orientation, m.signal_quality) for m in distances} == {(123, 25, 100)}
    assert ground[0].get_type() == "STATUSTEXT"


@pytest.mark.parametrize(("lidar_mm", "age_us"), [(1000, 60_001), (0, 0), (49, 0), (40_001, 0), (0xFFFFFFFF, 0)])
def test_unusable_distance_is_out_of_range(firmware: Firmware, lidar_mm: int | None, age_us: int) -> None:
    firmware.tick(0, lidar_mm=lidar_mm, age_us=age_us)
    message = only(firmware.take(AUTOPILOT), "DISTANCE_SENSOR")
    assert message.current_distance > message.max_distance
    assert message.signal_quality == 1


def test_lidar_that_never_worked_is_silent(firmware: Firmware) -> None:
    """An autopilot must see "no data" and refuse to arm; later, "out of range" is the truth."""

    def distances(start_us: int, lidar_mm: int | None) -> list[tuple[int, int]]:
        for now_us in range(start_us, start_us + 1_000_000, 10_000):
            firmware.tick(now_us, lidar_mm=lidar_mm)
        messages = [m for m in firmware.take(AUTOPILOT) if m.get_type() == "DISTANCE_SENSOR"]
        return [(m.current_distance, m.signal_quality) for m in messages]

    assert distances(0, None) == []
    assert distances(1_000_000, 1000) == [(100, 100)] * 20
    assert distances(2_000_000, None) == [(4001, 1)] * 20


def test_health(firmware: Firmware) -> None:
    counts = {"frames_malformed": 3, "frames_overflow": 5, "objects_dropped": 0, "min_area": 31}
    firmware.on_record(record_of(Pose(1.0), **counts))
    firmware.on_record(b"nonsense")
    firmware.tick(0)
    arrays = {message.name: message for message in firmware.take(GROUND) if message.get_type() == "DEBUG_FLOAT_ARRAY"}
    assert arrays["HEALTH"].array_id == 2
    assert list(arrays["HEALTH"].data[:12]) == [1, 1, 1, 3, 5, 0, 100, 0, 0, 0, 0, 0]


def test_lost_camera_is_told_once(firmware: Firmware) -> None:
    for now_us in range(0, 5_000_000, 5000):
        firmware.tick(now_us)
    firmware.on_record(result_writer.record(HEADER, np.zeros(0, OBJECT_DTYPE)), 5_000_000)
    firmware.tick(5_000_001)
    texts = [message.text for message in firmware.take(GROUND) if message.get_type() == "STATUSTEXT"]
    assert texts == [
        "Touchdown: started",
        "Touchdown: no frames, check camera and FRAME_SIZE",
        "Touchdown: frames again",
    ]


def test_timesync_is_answered(firmware: Firmware) -> None:
    autopilot = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    request = autopilot.timesync_encode(0, 987_654_321).pack(autopilot)
    reply_to_other = autopilot.timesync_encode(5, 6).pack(autopilot)
    damaged = bytearray(request)
    damaged[-3] ^= 0xFF
    firmware.on_bytes(AUTOPILOT, b"noise\xfd" + bytes(300), 1000)
    firmware.on_bytes(AUTOPILOT, bytes(damaged) + reply_to_other, 1000)
    assert firmware.take(AUTOPILOT) == []
    for byte in request:
        firmware.on_bytes(AUTOPILOT, bytes([byte]), 5_000_000_000)
    reply = only(firmware.take(AUTOPILOT), "TIMESYNC")
    assert (reply.tc1, reply.ts1) == (5_000_000_000_000, 987_654_321)
    assert firmware.take(GROUND)[0].get_type() == "STATUSTEXT"


def test_time_is_asked_for(firmware: Firmware) -> None:
    """Once a second from the first HEARTBEAT of an autopilot on; nothing is asked of a wire without one."""
    autopilot = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    beat = mavlink.MAVLink_heartbeat_message(2, mavlink.MAV_AUTOPILOT_PX4, 0, 0, 4, 3)
    firmware.tick(1_000_000)
    assert not [message for message in firmware.take(AUTOPILOT) if message.get_type() == "TIMESYNC"]
    for now_us in range(2_000_000, 5_000_000, 1000):
        if now_us % 1_000_000 == 0:
            firmware.on_bytes(AUTOPILOT, bytes(beat.pack(autopilot)), now_us)
        firmware.tick(now_us)
    asked = [message for message in firmware.take(AUTOPILOT) if message.get_type() == "TIMESYNC"]
    assert [(message.tc1, message.ts1) for message in asked] == [(0, second * 10**9) for second in (2, 3, 4)]
    assert not [message for message in firmware.take(GROUND) if message.get_type() == "TIMESYNC"]


def test_a_start_in_the_air_commands_nothing(firmware: Firmware) -> None:
    """As after a reset by the watchdog: armed, steered until then, the switch on, the pad in sight; all is well."""
    autopilot = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    base = mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED | mavlink.MAV_MODE_FLAG_SAFETY_ARMED
    guided = mavlink.MAVLink_heartbeat_message(2, mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA, base, 4, 4, 3)
    switch_on = mavlink.MAVLink_rc_channels_message(0, 8, *([1500] * 7), 2000, *([0] * 10), 200)
    in_air = mavlink.MAVLink_extended_sys_state_message(0, mavlink.MAV_LANDED_STATE_IN_AIR)
    said = [(guided, 1_000_000), (switch_on, 100_000), (in_air, 200_000)]
    record = record_of(Pose(1.0), altitude_valid=1, altitude_mm=1000)
    for now_us in range(1_000_000, 11_000_000, 5000):
        for message, period_us in said:
            if now_us % period_us == 0:
                firmware.on_bytes(AUTOPILOT, bytes(message.pack(autopilot)), now_us)
        if now_us % 20_000 == 0:
            firmware.attitude(0.0, 0.0, now_us)
            number = now_us // 20_000
            frame = (now_us - 16_000).to_bytes(8, "little") + record[16:60] + number.to_bytes(4, "little") + record[64:]
            assert firmware.on_record(record[:8] + frame, now_us) == 0
        firmware.tick(now_us)
    sent = firmware.take(AUTOPILOT)
    kinds = {message.get_type() for message in sent}
    assert kinds == {"HEARTBEAT", "DISTANCE_SENSOR", "LANDING_TARGET", "TIMESYNC", "COMMAND_LONG"}
    commands = {message.command for message in sent if message.get_type() == "COMMAND_LONG"}
    assert commands == {mavlink.MAV_CMD_SET_MESSAGE_INTERVAL}
    texts = [message.text for message in firmware.take(GROUND) if message.get_type() == "STATUSTEXT"]
    assert texts == ["Touchdown: started"]
