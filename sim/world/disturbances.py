# SPDX-License-Identifier: Apache-2.0
"""What may go wrong between the pad and the picture."""

from dataclasses import dataclass

from sim.world.decal import OCCLUDERS

_MOST_OCCLUSION = 0.5
_MOST_STEPS = 8.0


@dataclass(frozen=True)
class Disturbances:
    """What may go wrong besides pose and `Look`; 0 is absent everywhere.

    Attributes:
        shadow_edge: Light that is lost beyond a straight edge across the pad, 0 to 1.
        penumbra_mm: Width over which it is lost.
        occlusion: Share of the pad's disc that is covered, 0 to 0.5.
        occluder: By what: one of `decal.OCCLUDERS`.
        dirt: Share of the way round the ring that light blotches take, 0 to 1; dark ones come with them.
        wet: How much of the white of the sky a wet patch near the pad's middle reflects, 0 to 1.
        contrast_loss: How far the levels of print and paper are drawn together, 0 to 1 (1 = alike).
        glare: Sun into the lens and paper burnt out: 0.5 is about as bad as the worst of the photographs.
        exposure_ev: Steps of exposure; +1 is twice the level.
        curl_per_m: 1 / radius of the cylinder the paper is a part of.
        legs: How far up from the lower edge the airframe's legs reach on both sides, as a share of the frame's height.
    """

    shadow_edge: float = 0.0
    penumbra_mm: float = 12.0
    occlusion: float = 0.0
    occluder: str = "grass"
    dirt: float = 0.0
    wet: float = 0.0
    contrast_loss: float = 0.0
    glare: float = 0.0
    exposure_ev: float = 0.0
    curl_per_m: float = 0.0
    legs: float = 0.0

    def __post_init__(self) -> None:
        for name in ("shadow_edge", "dirt", "wet", "contrast_loss", "glare", "legs"):
            if not 0 <= getattr(self, name) <= 1:
                raise ValueError(f"{name} is {getattr(self, name)}; it must be within 0 and 1")
        if not 0 <= self.occlusion <= _MOST_OCCLUSION:
            raise ValueError(f"occlusion is {self.occlusion}; it must be within 0 and {_MOST_OCCLUSION}")
        if not abs(self.exposure_ev) <= _MOST_STEPS:
            raise ValueError(f"exposure_ev is {self.exposure_ev}; it must be within {_MOST_STEPS} steps")
        if not self.penumbra_mm > 0:
            raise ValueError(f"penumbra_mm is {self.penumbra_mm}; it must be above 0")
        if self.occluder not in OCCLUDERS:
            raise ValueError(f"occluder is {self.occluder}; it must be one of {', '.join(OCCLUDERS)}")


UNDISTURBED = Disturbances()
