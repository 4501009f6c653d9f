# SPDX-License-Identifier: Apache-2.0
"""An autopilot as far as a companion computer sees it: HEARTBEAT, streams when asked for, modes, setpoints, LAND.

What it accepts is what was seen of ArduCopter 4.7 and read in PX4's source (docs/landing.md); it is no substitute for
either, and knows nothing but what the firmware uses.
"""

import math
from dataclasses import dataclass, field

from pymavlink.dialects.v20 import common as mavlink

from sim.flight.vehicle import Vehicle

ARDUPILOT, PX4 = "ardupilot", "px4"
CODES = {
    ARDUPILOT: {"steer": 4, "land": 9, "hold": 17, "loiter": 5, "rtl": 6},
    PX4: {
        "steer": 6 << 16,
        "land": 4 << 16 | 9 << 24,
        "hold": 4 << 16 | 3 << 24,
        "loiter": 3 << 16,
        "rtl": 4 << 16 | 5 << 24,
    },
}
"""HEARTBEAT.custom_mode by what the mode is for; "loiter" is what the pilot flies in."""
_SETPOINT_TIMEOUT_US = {ARDUPILOT: 3_000_000, PX4: 500_000}
_LAND_M_S = 0.3
_LAND_GAIN = 0.8
_LAND_TARGET_US = 2_000_000
_DISARM_AFTER_US = 1_000_000
_VELOCITY_MASK = 0x05C7
_LAND_SPEED_MAX = 0.5


@dataclass
class Autopilot:
    """One autopilot.

    Attributes:
        profile: `ARDUPILOT` or `PX4`.
        vehicle: What it flies.
        mode: Key of `CODES`.
        silent: It sends nothing and hears nothing.
        refuses: It answers mode requests with DENIED.
        deaf: It does not act on mode requests, and says nothing of it.
        sticky: It does not disarm after touchdown by itself.
        slow_heartbeat: HEARTBEAT comes once a second whatever is asked for.
        no_attitude: It sends no ATTITUDE.
        battery_percent: As SYS_STATUS says.
        rc_us: Channels, 0 = none.
        setpoint: Newest velocity ahead, right, up and yaw rate.
        setpoint_us: When it came.
        target: Newest angle_x and angle_y of LANDING_TARGET.
        target_us: When it came.
        told: Mode that its newest HEARTBEAT showed.
        told_us: When one showed it first.
        stood_us: Since when it stands in LAND.
        intervals_us: Of the messages that it sends, by their numbers.
        next_us: When each is due.
    """

    profile: str
    vehicle: Vehicle
    mode: str = "loiter"
    armed: bool = True
    silent: bool = False
    refuses: bool = False
    deaf: bool = False
    sticky: bool = False
    slow_heartbeat: bool = False
    no_attitude: bool = False
    battery_percent: int = 80
    rc_us: list[int] = field(default_factory=lambda: [1500] * 7 + [1000] + [0] * 10)
    setpoint: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    setpoint_us: int | None = None
    target: tuple[float, float] | None = None
    target_us: int = 0
    told: str | None = None
    told_us: int = 0
    stood_us: int | None = None
    intervals_us: dict[int, int] = field(default_factory=dict)
    next_us: dict[int, int] = field(default_factory=lambda: {mavlink.MAVLINK_MSG_ID_HEARTBEAT: 0})

    def __post_init__(self) -> None:
        self._out = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
        self._in = mavlink.MAVLink(None)
        self._in.robust_parsing = True
        self.intervals_us.setdefault(mavlink.MAVLINK_MSG_ID_HEARTBEAT, 1_000_000)

    def hear(self, data: bytes, now_us: int) -> bytes:
        """Take what the firmware sent; returns the answers."""
        answers = b""
        for message in self._in.parse_buffer(data) or []:
            kind = message.get_type()
            if self.silent:
                continue
            if kind == "COMMAND_LONG":
                answers += self._command(message, now_us)
            elif kind == "SET_POSITION_TARGET_LOCAL_NED":
                assert message.type_mask == _VELOCITY_MASK, f"mask {message.type_mask:#x} is not taken"
                assert message.coordinate_frame in (8, 9), f"frame {message.coordinate_frame} is not taken"
                self.setpoint = (message.vx, message.vy, -message.vz, message.yaw_rate)
                self.setpoint_us = now_us
            elif kind == "LANDING_TARGET":
                assert message.frame == mavlink.MAV_FRAME_BODY_FRD, f"frame {message.frame} is not taken"
                self.target = (message.angle_x, message.angle_y)
                self.target_us = now_us
        return answers

    def _command(self, message: mavlink.MAVLink_message, now_us: int) -> bytes:
        result = mavlink.MAV_RESULT_ACCEPTED
        if message.command == mavlink.MAV_CMD_SET_MESSAGE_INTERVAL:
            result = self._set_interval(int(message.param1), int(message.param2), now_us)
        elif message.command == mavlink.MAV_CMD_DO_SET_MODE:
            if self.deaf:
                return b""
            result = self._request(message, now_us)
        elif message.command == mavlink.MAV_CMD_COMPONENT_ARM_DISARM:
            if self.vehicle.stands and message.param1 == 0:
                self.armed = False
            else:
                result = mavlink.MAV_RESULT_DENIED
        else:
            result = mavlink.MAV_RESULT_UNSUPPORTED
        ack = mavlink.MAVLink_command_ack_message(message.command, result, 0, 0, 1, 191)
        return self._pack(ack)

    def _set_interval(self, number: int, interval_us: int, now_us: int) -> int:
        if number == mavlink.MAVLINK_MSG_ID_HEARTBEAT and self.slow_heartbeat:
            return mavlink.MAV_RESULT_DENIED
        self.intervals_us[number] = interval_us
        self.next_us.setdefault(number, now_us)
        return mavlink.MAV_RESULT_ACCEPTED

    def _request(self, message: mavlink.MAVLink_message, now_us: int) -> int:
        code = int(message.param2)
        if self.profile == PX4:
            code = code << 16 | int(message.param3) << 24
        wanted = next((mode for mode, value in CODES[self.profile].items() if value == code), None)
        if self.refuses or wanted is None:
            return mavlink.MAV_RESULT_DENIED
        # PX4 takes OFFBOARD only while setpoints come.
        if self.profile == PX4 and wanted == "steer" and not self._steered(now_us):
            return mavlink.MAV_RESULT_TEMPORARILY_REJECTED
        self.mode = wanted
        return mavlink.MAV_RESULT_ACCEPTED

    def _steered(self, now_us: int) -> bool:
        return self.setpoint_us is not None and now_us - self.setpoint_us <= _SETPOINT_TIMEOUT_US[self.profile]

    def fly(self, now_us: int, dt_s: float, wind_m_s2: tuple[float, float] = (0.0, 0.0)) -> None:
        """Let the vehicle do what the mode says."""
        vehicle = self.vehicle
        wanted, yaw_rate = (0.0, 0.0, 0.0), 0.0
        # COM_OBL_RC_ACT as it comes: without setpoints the pilot has it.
        if self.profile == PX4 and self.mode == "steer" and not self._steered(now_us):
            self.mode = "loiter"
        if self.mode == "steer" and self._steered(now_us):
            wanted, yaw_rate = self.setpoint[:3], self.setpoint[3]
        elif self.mode == "land":
            wanted = self._landing(now_us)
        if not self.armed:
            wanted, wind_m_s2 = (0.0, 0.0, -2.0), (0.0, 0.0)
        vehicle.move(wanted, yaw_rate, wind_m_s2, dt_s)
        if not (vehicle.stands and self.mode == "land"):
            self.stood_us = None
        elif self.stood_us is None:
            self.stood_us = now_us
        elif now_us - self.stood_us >= _DISARM_AFTER_US and not self.sticky:
            self.armed = False

    def _landing(self, now_us: int) -> tuple[float, float, float]:
        ahead = right = 0.0
        if self.target is not None and now_us - self.target_us <= _LAND_TARGET_US:
            # Raw body angles: it takes roll and pitch out itself.
            right = _LAND_GAIN * self.vehicle.height_m * math.tan(self.target[0] - self.vehicle.roll_rad)
            ahead = _LAND_GAIN * self.vehicle.height_m * math.tan(-self.target[1] + self.vehicle.pitch_rad)
        speed = math.hypot(ahead, right)
        scale = min(1.0, _LAND_SPEED_MAX / speed) if speed > 0 else 1.0
        return ahead * scale, right * scale, -_LAND_M_S

    def say(self, now_us: int) -> bytes:
        """What it sends by itself up to now."""
        if self.silent:
            return b""
        sent = b""
        for number, due_us in self.next_us.items():
            if now_us >= due_us:
                self.next_us[number] = now_us + self.intervals_us[number]
                message = self._message(number, now_us)
                sent += self._pack(message) if message is not None else b""
        return sent

    def _message(self, number: int, now_us: int) -> mavlink.MAVLink_message | None:
        if number == mavlink.MAVLINK_MSG_ID_HEARTBEAT:
            base = mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED | (mavlink.MAV_MODE_FLAG_SAFETY_ARMED if self.armed else 0)
            kind = mavlink.MAV_AUTOPILOT_PX4 if self.profile == PX4 else mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA
            code = CODES[self.profile][self.mode]
            if self.told != self.mode:
                self.told, self.told_us = self.mode, now_us
            return mavlink.MAVLink_heartbeat_message(mavlink.MAV_TYPE_QUADROTOR, kind, base, code, 4, 3)
        if number == mavlink.MAVLINK_MSG_ID_ATTITUDE and not self.no_attitude:
            vehicle = self.vehicle
            return mavlink.MAVLink_attitude_message(
                now_us // 1000, vehicle.roll_rad, vehicle.pitch_rad, vehicle.heading_rad, 0.0, 0.0, 0.0
            )
        if number == mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE:
            landed = mavlink.MAV_LANDED_STATE_ON_GROUND if self.vehicle.stands else mavlink.MAV_LANDED_STATE_IN_AIR
            return mavlink.MAVLink_extended_sys_state_message(0, landed)
        if number == mavlink.MAVLINK_MSG_ID_SYS_STATUS:
            return mavlink.MAVLink_sys_status_message(0, 0, 0, 0, 11000, -1, self.battery_percent, 0, 0, 0, 0, 0, 0)
        if number == mavlink.MAVLINK_MSG_ID_RC_CHANNELS:
            return mavlink.MAVLink_rc_channels_message(now_us // 1000, 8, *self.rc_us, 200)
        return None

    def _pack(self, message: mavlink.MAVLink_message | None) -> bytes:
        return bytes(message.pack(self._out)) if message is not None else b""
