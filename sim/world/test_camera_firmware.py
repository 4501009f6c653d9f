# SPDX-License-Identifier: Apache-2.0
"""The renderer's camera and the firmware's are inverse to each other."""

import ctypes
import subprocess
from pathlib import Path

import numpy as np
import pytest

from scripts.camera_file import DEFAULT, header_of, read_camera
from sim.world.camera import Camera
from sim.world.pose import Pose, truth_of

_CAMERA = ("focal_px", "centre_x_px", "centre_y_px", "width_px", "height_px", "radial_2", "radial_4")

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "firmware" / "core" / "camera.c"


class FirmwareCamera(ctypes.Structure):
    """`struct camera` of firmware/core/camera.h."""

    _fields_ = tuple((name, ctypes.c_double) for name in _CAMERA)


class Ray(ctypes.Structure):
    """`struct camera_ray`."""

    _fields_ = tuple((name, ctypes.c_double) for name in ("right", "forward"))


@pytest.fixture(scope="module")
def firmware(tmp_path_factory: pytest.TempPathFactory) -> ctypes.CDLL:
    """firmware/core/camera.c, compiled for this machine with the camera of firmware/camera.toml."""
    folder = tmp_path_factory.mktemp("camera")
    (folder / "camera_default.h").write_text(header_of(read_camera(DEFAULT)))
    library = folder / "camera.so"
    subprocess.run(["gcc", "-shared", "-fPIC", "-O1", f"-I{folder}", "-o", library, SOURCE, "-lm"], check=True)
    loaded = ctypes.CDLL(str(library))
    loaded.camera_unproject.argtypes = [ctypes.c_void_p, ctypes.c_double, ctypes.c_double, ctypes.c_void_p]
    loaded.camera_scaled.argtypes = [ctypes.c_void_p, ctypes.c_double]
    loaded.camera_scaled.restype = FirmwareCamera
    return loaded


@pytest.mark.parametrize("divisor", [1, 4])
@pytest.mark.parametrize(
    "camera",
    [Camera(), Camera(1280, 720, 548.0, 655.0, 341.0, -0.03, 0.004), Camera(radial_2=0.02), Camera(radial_4=-0.004)],
)
def test_firmware_inverts_the_renderer(firmware: ctypes.CDLL, camera: Camera, divisor: int) -> None:
    given = FirmwareCamera(
        camera.focal_px,
        camera.centre_x,
        camera.centre_y,
        camera.width,
        camera.height,
        camera.radial_2,
        camera.radial_4,
    )
    if camera == Camera():
        assert bytes(given) == bytes(FirmwareCamera.in_dll(firmware, "camera_default"))
    camera = camera.scaled(divisor)
    scaled = firmware.camera_scaled(ctypes.byref(given), float(camera.width))
    random = np.random.default_rng(4)
    for right, forward, altitude in random.uniform((-3, -2, 0.3), (3, 2, 4), (300, 3)):
        truth = truth_of(camera, Pose(altitude, right, forward))
        ray = Ray()
        code = firmware.camera_unproject(ctypes.byref(scaled), truth.x_px, truth.y_px, ctypes.byref(ray))
        if code:
            # Only what is 80 degrees or more off axis may be refused.
            assert np.hypot(right, forward) / altitude > np.tan(np.radians(79.9))
            continue
        assert ray.right * altitude == pytest.approx(right, abs=1e-9)
        assert ray.forward * altitude == pytest.approx(forward, abs=1e-9)
