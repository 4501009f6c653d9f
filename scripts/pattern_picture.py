# SPDX-License-Identifier: Apache-2.0
"""docs/pictures/cores/pattern_source.jpg: what `pattern_source` sends, and where: `python -m scripts.pattern_picture`.

The pixels are those of the golden model, which the RTL equals. The line is the path of the pad's centre.
"""

import cv2
import numpy as np

from golden.pattern_source import centre, frame
from scripts.errors import UserError, run_main
from tb.common.cores import ROOT

PICTURE = ROOT / "docs/pictures/cores/pattern_source.jpg"
NUMBER, STEPS = 150, 3000
PATH_BGR = (0, 128, 255)


def main() -> int:
    """Draw it, half as large: it is a picture of a page."""
    half = cv2.resize(frame(NUMBER, move=True)[..., ::-1], None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)
    path = np.array([centre(number, move=True) for number in range(STEPS)]) // 2
    cv2.polylines(half, [path.astype(np.int32)], False, PATH_BGR, 1, cv2.LINE_8)
    cv2.circle(half, tuple(path[NUMBER].tolist()), 4, PATH_BGR, -1)
    if not cv2.imwrite(str(PICTURE), half, (cv2.IMWRITE_JPEG_QUALITY, 88)):
        raise UserError(f"{PICTURE} cannot be written; see that its folder is there.")
    return 0


if __name__ == "__main__":
    run_main(main)
