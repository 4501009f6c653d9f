# SPDX-License-Identifier: Apache-2.0
"""MAVLink messages out of the bytes of a UART, each with the time at which its last byte had left."""

import os
from collections.abc import Sequence
from dataclasses import dataclass

# pymavlink reads the dialect's wire format from the environment when it is imported.
os.environ.setdefault("MAVLINK20", "1")
from pymavlink.dialects.v20 import common

PAD_ARRAY_NAME = "PAD"
PAD_FIELDS = (
    "found",
    "x_px",
    "y_px",
    "angle_deg",
    "altitude_m",
    "right_m",
    "forward_m",
    "frame_number",
    "object_count",
    "flags",
    "doubt",
    "size_altitude_m",
)
"""The elements of the ground station's DEBUG_FLOAT_ARRAY; `firmware/core/app.h` owns the order."""


@dataclass(frozen=True)
class Message:
    """One message of a line.

    Attributes:
        kind: Its MAVLink name.
        sequence: Its sequence number on this line.
        done_ns: Simulated time at which its last stop bit ended.
        fields: What it says, by field name.
    """

    kind: str
    sequence: int
    done_ns: int
    fields: dict


@dataclass(frozen=True)
class Line:
    """All that a UART sent.

    Attributes:
        messages: In order.
        bad_bytes: Bytes that belong to no whole message.
        lost: Messages that the sequence numbers say are missing.
    """

    messages: list[Message]
    bad_bytes: int
    lost: int

    def of(self, kind: str) -> list[Message]:
        """The messages of one kind."""
        return [message for message in self.messages if message.kind == kind]


def decode(data: bytes, done_ns: Sequence[int]) -> Line:
    """Find the messages in the bytes of one UART.

    Args:
        data: The bytes as they left the board.
        done_ns: One time a byte: the end of its stop bit.
    """
    if len(data) != len(done_ns):
        raise ValueError(f"{len(data)} bytes came with {len(done_ns)} times")
    parser = common.MAVLink(None)
    parser.robust_parsing = True
    messages: list[Message] = []
    good = 0
    lost = 0
    for index in range(len(data)):
        parsed = parser.parse_char(data[index : index + 1])
        if parsed is None or parsed.get_type() == "BAD_DATA":
            continue
        good += len(parsed.get_msgbuf())
        sequence = parsed.get_seq()
        if messages:
            lost += (sequence - messages[-1].sequence - 1) % 256
        fields = {name: getattr(parsed, name) for name in parsed.get_fieldnames()}
        messages.append(Message(parsed.get_type(), sequence, int(done_ns[index]), fields))
    return Line(messages, len(data) - good, lost)


def pad_report(message: Message) -> dict[str, float] | None:
    """The named values of a PAD array; None for any other message."""
    if message.kind != "DEBUG_FLOAT_ARRAY" or message.fields["name"].rstrip("\0") != PAD_ARRAY_NAME:
        return None
    return dict(zip(PAD_FIELDS, message.fields["data"], strict=False))
