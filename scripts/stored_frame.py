# SPDX-License-Identifier: Apache-2.0
"""A picture as `frame_source` plays it from memory: `python -m scripts.stored_frame photo.jpg -o frame.bin`.

The picture must have the size of the camera; nothing is scaled.
"""

from pathlib import Path

from golden.frame_source import memory_of
from scripts.errors import ArgumentParser, UserError, run_main
from scripts.frames import read_picture


def main() -> int:
    """Entry point of the command line."""
    parser = ArgumentParser(prog="python -m scripts.stored_frame", description=__doc__)
    parser.add_argument("picture", type=Path, help="a picture of 1280x720, PNG or JPEG or what else OpenCV reads")
    parser.add_argument("-o", "--output", type=Path, required=True, help="file for the memory of the board")
    arguments = parser.parse_args()
    data = memory_of(read_picture(arguments.picture))
    try:
        arguments.output.write_bytes(data)
    except OSError as error:
        raise UserError(f"{arguments.output} cannot be written: {error.strerror}; give another file by -o.") from error
    print(f"{arguments.output}: {len(data)} bytes, for an address that is a multiple of 4096")
    return 0


if __name__ == "__main__":
    run_main(main)
