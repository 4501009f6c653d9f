# SPDX-License-Identifier: Apache-2.0
"""What lies on the paper or on the ground, as pictures with a mask: occluders, dirt, drawings that are no pad."""

import functools
import math
from dataclasses import dataclass

import cv2
import numpy as np

from golden import pad_geometry as pad
from sim.world.ground_pictures import leaf_outline
from sim.world.pad import RECTANGLE, SQUARE, Ring
from sim.world.texture import Texture

SIDE_PX = 1024
SIDE_MM = 700.0
OCCLUDERS = ("grass", "leaf", "foot")

_PX_PER_MM = SIDE_PX / SIDE_MM
_SUB = 16
_SUB_BITS = 4
_RING_MIDDLE_MM = (pad.RING_OUTER_RADIUS_MM + pad.RING_INNER_RADIUS_MM) / 2
_DARK_BLOTCH_RADIUS_MM = (2.0, 5.0)
_LIGHT_BLOTCH_RADIUS_MM = (9.0, 22.0)
_CLEAR_OF_SHAPES_MM = 9.0
_LIGHT_BEYOND_MM = 97.0
_MIDDLE = Ring(pad.SMALL_RING_OUTER_RADIUS_MM, 0.0)
_LEAF_RGB = np.array([(150.0, 92.0, 44.0), (178.0, 122.0, 58.0), (120.0, 126.0, 62.0)])
# Colour is drawn wider than its mask, so that the mask alone makes the soft edge.
_BLEED_MM = 3.0
_MOST_BLADES = 6000
_BLADES_A_CHECK = 4
_HALVINGS = 10


@dataclass(frozen=True, eq=False)
class Decal:
    """A picture about the origin of the plane it lies on.

    Attributes:
        colour: (n, n, 3) uint8 RGB, black where `mask` is 0.
        mask: (n, n) uint8, 255 = opaque.
    """

    colour: Texture
    mask: Texture
    mask_picture: np.ndarray

    @staticmethod
    def of(colour: np.ndarray, mask: np.ndarray) -> "Decal":
        """From a picture and its mask; what is under no mask does not matter."""
        covered = (colour * (mask[..., None] / np.float32(255.0))).astype(np.uint8)
        return Decal(Texture(covered, SIDE_MM, repeats=False), Texture(mask, SIDE_MM, repeats=False), mask)

    def lay_over(self, image: np.ndarray, x_mm: np.ndarray, y_mm: np.ndarray, footprint_mm: np.ndarray) -> np.ndarray:
        """The image (height, width, 3) float32 with the decal on top."""
        clear = 1 - self.mask.sample(x_mm, y_mm, footprint_mm) * np.float32(1 / 255)
        return image * clear[..., None] + self.colour.sample(x_mm, y_mm, footprint_mm)

    def opacity_at(self, points_mm: np.ndarray) -> np.ndarray:
        """(n,) 0 to 1 at points (n, 2) of the plane."""
        texel = np.floor((points_mm / SIDE_MM + 0.5) * SIDE_PX).astype(int)
        inside = ((texel >= 0) & (texel < SIDE_PX)).all(axis=1)
        column, line = np.clip(texel, 0, SIDE_PX - 1).T
        return np.where(inside, self.mask_picture[line, column] / 255.0, 0.0)


def texels(points_mm: np.ndarray) -> np.ndarray:
    """Points (n, 2) of the plane as cv2 takes them with `_SUB_BITS` bits below the texel."""
    return np.rint(((np.asarray(points_mm) / SIDE_MM + 0.5) * SIDE_PX - 0.5) * _SUB).astype(np.int32)


def fill(picture: np.ndarray, outline_mm: np.ndarray, colour: tuple[float, ...] | float) -> None:
    """A filled outline (n, 2) in mm."""
    cv2.fillPoly(picture, [texels(outline_mm)], colour, cv2.LINE_AA, _SUB_BITS)


def stroke(picture: np.ndarray, path_mm: np.ndarray, colour: tuple[float, ...] | float, width_mm: float) -> None:
    """A path (n, 2) in mm with round ends."""
    width = max(1, round(width_mm * _PX_PER_MM))
    cv2.polylines(picture, [texels(path_mm)], False, colour, width, cv2.LINE_AA, _SUB_BITS)


def _blank() -> tuple[np.ndarray, np.ndarray]:
    return np.zeros((SIDE_PX, SIDE_PX, 3), np.uint8), np.zeros((SIDE_PX, SIDE_PX), np.uint8)


def _circle(radius_mm: float) -> np.ndarray:
    turn = np.linspace(0, 2 * np.pi, 720, endpoint=False)
    return radius_mm * np.column_stack([np.cos(turn), np.sin(turn)])


@functools.cache
def _disc() -> np.ndarray:
    disc = np.zeros((SIDE_PX, SIDE_PX), np.uint8)
    fill(disc, _circle(pad.RING_OUTER_RADIUS_MM), 255)
    return disc


def covered_share(mask: np.ndarray) -> float:
    """Share of the pad's disc (out to the ring's outer edge) that a mask covers."""
    return cv2.mean(mask, mask=_disc())[0] / 255.0


@functools.lru_cache(maxsize=8)
def occluder(kind: str, share: float, seed: int) -> Decal:
    """Something that covers this share of the pad's disc.

    Args:
        kind: `grass` is stalks that lean over the pad, `leaf` some leaves on it, `foot` a boot on its edge.
        share: 0 to 0.5.
        seed: Another seed is another place.
    """
    random = np.random.default_rng([seed, 21])
    if kind == "grass":
        return _stalks(random, share)
    place = _leaves if kind == "leaf" else _foot
    state = random.bit_generator.state

    def attempt(size: float) -> tuple[np.ndarray, np.ndarray]:
        # The same random numbers each time, so that only the size differs.
        random.bit_generator.state = state
        return place(random, share, size)

    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if covered_share(attempt(middle)[1]) < share else (low, middle)
    return Decal.of(*attempt((low + high) / 2))


def _stalks(random: np.random.Generator, share: float) -> Decal:
    colour, mask = _blank()
    side = random.uniform(0, 2 * np.pi)
    for blade in range(_MOST_BLADES):
        if blade % _BLADES_A_CHECK == 0 and covered_share(mask) >= share:
            break
        # Roots lie outside the ring, most of them on one side.
        root_turn, root_radius = side + random.normal(0, 0.9), random.uniform(105, 230)
        lean = root_turn + np.pi + random.normal(0, 0.6)
        root = root_radius * np.array([math.cos(root_turn), math.sin(root_turn)])
        bend = lean + random.normal(0, 0.35) * np.linspace(0, 1, 5)
        reach = random.gamma(5.0, 26.0) * np.linspace(0, 1, 5)[:, None]
        path = root + reach * np.column_stack([np.cos(bend), np.sin(bend)])
        tone = random.uniform(0.4, 1.1) * np.array([168.0, 152.0, 106.0])
        width = random.uniform(1.2, 4.5)
        stroke(colour, path, tuple(tone.tolist()), width + _BLEED_MM)
        stroke(mask, path, 255, width)
    return Decal.of(colour, mask)


def _leaves(random: np.random.Generator, share: float, size: float) -> tuple[np.ndarray, np.ndarray]:
    colour, mask = _blank()
    for _ in range(1 + int(share / 0.08)):
        radius, turn = 115 * math.sqrt(random.random()), random.uniform(0, 2 * np.pi)
        centre = radius * np.array([math.cos(turn), math.sin(turn)])
        tone = random.uniform(0.55, 1.1) * _LEAF_RGB[random.integers(len(_LEAF_RGB))]
        outline = leaf_outline(centre, 200.0 * size * random.uniform(0.7, 1.0), random.uniform(0, 2 * np.pi))
        fill(colour, outline, tuple(tone.tolist()))
        stroke(colour, np.vstack([outline, outline[:1]]), tuple(tone.tolist()), _BLEED_MM)
        fill(mask, outline, 255)
    return colour, mask


def _foot(random: np.random.Generator, share: float, size: float) -> tuple[np.ndarray, np.ndarray]:
    colour, mask = _blank()
    turn, aside = random.uniform(0, 2 * np.pi), random.uniform(-30, 30)
    inward = -np.array([math.cos(turn), math.sin(turn)])
    across = np.array([-inward[1], inward[0]])
    width = 95.0 + 130.0 * share
    # The toe's middle runs from beyond the ring through to its other side.
    toe = inward * (300.0 * size - 125.0 - width / 2) + across * aside
    path = np.array([toe, toe - 200.0 * inward])
    tone = float(random.uniform(25, 60))
    stroke(mask, path, 255, width)
    stroke(colour, path, (1.9 * tone, 1.8 * tone, 1.7 * tone), width + _BLEED_MM)
    stroke(colour, path, (tone, tone, 1.05 * tone), width - 14)
    return colour, mask


@functools.lru_cache(maxsize=8)
def dirt(share: float, seed: int) -> tuple[Texture, Texture, float]:
    """Blotches on the print.

    Args:
        share: The light ones are, laid side by side, this share of the way round the ring; the dark ones are as many
            again, on the paper, clear of square, rectangle and small ring.
        seed: Another seed is another place.

    Returns:
        Masks of what turns to paper and of what turns to print, and the share of the ring's print that is gone.
    """
    random = np.random.default_rng([seed, 22])
    light, dark = _blank()[1], _blank()[1]
    wanted, laid = share * 2 * np.pi * _RING_MIDDLE_MM, 0.0
    while laid < wanted:
        radius = min(random.uniform(*_LIGHT_BLOTCH_RADIUS_MM), max((wanted - laid) / 2, 1.0))
        laid += 2 * radius
        turn, off = random.uniform(0, 2 * np.pi), random.uniform(-8, 8)
        fill(light, _blotch(random, (_RING_MIDDLE_MM + off) * np.array([math.cos(turn), math.sin(turn)]), radius), 255)
        for _ in range(3):
            fill(dark, _blotch(random, _free_place(random), random.uniform(*_DARK_BLOTCH_RADIUS_MM)), 255)
    # Square and rectangle come close to the ring.
    fill(light, _circle(_LIGHT_BEYOND_MM), 0)
    return Texture(light, SIDE_MM, repeats=False), Texture(dark, SIDE_MM, repeats=False), _ring_loss(light)


def _blotch(random: np.random.Generator, centre: np.ndarray, radius: float) -> np.ndarray:
    turn = np.linspace(0, 2 * np.pi, 14, endpoint=False)
    edge = radius * random.uniform(0.8, 1.2, 14)
    return centre + edge[:, None] * np.column_stack([np.cos(turn), np.sin(turn)])


def _free_place(random: np.random.Generator) -> np.ndarray:
    """A point of the paper that is clear of the shapes inside the ring."""
    while True:
        x, y = random.uniform(-130, 130, 2)
        point = np.array([x]), np.array([y])
        if all(shape.distance(*point)[0] > _CLEAR_OF_SHAPES_MM for shape in (SQUARE, RECTANGLE, _MIDDLE)):
            return np.array([x, y])


def _ring_loss(light: np.ndarray) -> float:
    ring = _disc().copy()
    fill(ring, _circle(pad.RING_INNER_RADIUS_MM), 0)
    return cv2.mean(light, mask=ring)[0] / 255.0
