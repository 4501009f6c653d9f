# SPDX-License-Identifier: Apache-2.0
"""A camera as a file: `camera.toml`, and the C header that the firmware is built with.

python -m scripts.camera_file --camera firmware/camera.toml --header build/firmware/camera_default.h
"""

import math
import os
import tomllib
from pathlib import Path

from scripts.errors import ArgumentParser, UserError, run_main
from sim.world.camera import Camera

ROOT = Path(__file__).resolve().parent.parent
DEFAULT = ROOT / "firmware" / "camera.toml"
FIELDS = {
    "width_px": "width",
    "height_px": "height",
    "focal_px": "focal_px",
    "centre_x_px": "centre_x",
    "centre_y_px": "centre_y",
    "radial_2": "radial_2",
    "radial_4": "radial_4",
}
"""Key of the file, which is the member of `struct camera` too, and attribute of `Camera`."""


def read_camera(path: Path) -> Camera:
    """The camera in a file.

    Raises:
        UserError: it cannot be read, or does not describe a camera.
    """
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise UserError(
            f"{path} cannot be read as TOML ({error}); give CAMERA=a file as make calibrate writes."
        ) from error
    if table.keys() != FIELDS.keys():
        odd = ", ".join(sorted(table.keys() ^ FIELDS.keys()))
        raise UserError(f"{path} needs exactly the keys {', '.join(FIELDS)}; missing or unknown: {odd}.")
    for key, value in table.items():
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            raise UserError(f"{key} in {path} is {value}; give a number.")
    if min(table["width_px"], table["height_px"], table["focal_px"]) <= 0:
        raise UserError(f"width_px, height_px and focal_px in {path} must be above 0; mend them.")
    try:
        return Camera(**{attribute: table[key] for key, attribute in FIELDS.items()})
    except ValueError as error:
        raise UserError(f"{path} describes no camera: {error}; mend radial_2 and radial_4.") from error


def text_of(camera: Camera, notes: list[str]) -> str:
    """A camera as `camera.toml`, below lines of comment."""
    lines = ["# SPDX-License-Identifier: Apache-2.0", *(f"# {note}" for note in notes)]
    lines += [f"{key} = {_number(getattr(camera, attribute))}" for key, attribute in FIELDS.items()]
    return "\n".join(lines) + "\n"


def header_of(camera: Camera) -> str:
    """A camera as the header that `firmware/core/camera.c` takes."""
    lines = ["// SPDX-License-Identifier: Apache-2.0", "// Made from camera.toml by scripts/camera_file.py."]
    lines += ["#ifndef TOUCHDOWN_CAMERA_DEFAULT_H", "#define TOUCHDOWN_CAMERA_DEFAULT_H", ""]
    lines += [
        f"#define CAMERA_{key.upper()} ({float(getattr(camera, attribute))!r})" for key, attribute in FIELDS.items()
    ]
    return "\n".join([*lines, "", "#endif", ""])


def _number(value: float) -> str:
    return str(value) if isinstance(value, int) else repr(round(value, 6))


def main(arguments: list[str] | None = None) -> None:
    """Entry point. The header is written only when it changes, so that nothing is compiled in vain."""
    parser = ArgumentParser(prog="python -m scripts.camera_file", description=__doc__)
    parser.add_argument("--camera", type=Path, default=DEFAULT, help="the camera, default firmware/camera.toml")
    parser.add_argument("--header", type=Path, required=True, help="the C header to write")
    options = parser.parse_args(arguments)
    text = header_of(read_camera(options.camera))
    if not options.header.is_file() or options.header.read_text(encoding="utf-8") != text:
        options.header.parent.mkdir(parents=True, exist_ok=True)
        # In one piece, because another build may be reading it.
        whole = options.header.with_name(f"{options.header.name}.{os.getpid()}")
        whole.write_text(text, encoding="utf-8")
        whole.replace(options.header)


if __name__ == "__main__":
    run_main(main)
