# SPDX-License-Identifier: Apache-2.0
"""What the fit leaves over, point by point, as an SVG the shape of the frame."""

import numpy as np

from scripts.calibrate_fit import Fit

_SCALES = (1000, 500, 200, 100, 50, 20, 10, 5)
_LONGEST_PX = 60.0


def residuals_svg(fit: Fit) -> str:
    """Each point where it was seen, with a line to where the model has it, so many times longer than it is."""
    camera = fit.camera
    seen = np.concatenate([view.seen[: view.pixels].reshape(-1, 2) for view in fit.views])
    left = np.concatenate(
        [rest[: view.pixels].reshape(-1, 2) for view, rest in zip(fit.views, fit.residuals(), strict=True)]
    )
    typical = float(np.percentile(np.linalg.norm(left, axis=1), 95))
    scale = next((scale for scale in _SCALES if scale * typical <= _LONGEST_PX), _SCALES[-1])
    ends = seen - scale * left
    lines = "".join(f"M{x:.1f} {y:.1f}L{to_x:.1f} {to_y:.1f}" for (x, y), (to_x, to_y) in zip(seen, ends, strict=True))
    dots = "".join(f"<circle cx='{x:.1f}' cy='{y:.1f}' r='2.5'/>" for x, y in seen)
    title = f"{len(seen)} points, errors {scale} times as long; + is the centre of the lens"
    x, y = camera.centre_x, camera.centre_y
    return (
        f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {camera.width} {camera.height + 44}' role='img' "
        f"aria-label='{title}' font-family='sans-serif'>"
        f"<rect width='{camera.width}' height='{camera.height + 44}' fill='#fff'/>"
        f"<rect x='1' y='1' width='{camera.width - 2}' height='{camera.height - 2}' fill='none' stroke='#888'/>"
        f"<path d='M{x - 14:.1f} {y:.1f}h28M{x:.1f} {y - 14:.1f}v28' stroke='#888' stroke-width='2'/>"
        f"<path d='{lines}' fill='none' stroke='#b3261e' stroke-width='1.5'/><g fill='#1f4e79'>{dots}</g>"
        f"<text x='12' y='{camera.height + 30}' font-size='24' fill='#333'>{title}</text></svg>\n"
    )
