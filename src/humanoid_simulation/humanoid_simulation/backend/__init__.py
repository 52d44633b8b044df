# SPDX-License-Identifier: Apache-2.0
"""MuJoCo simulation as a backend of the controllers."""

from humanoid_simulation.backend.contacts import Contact
from humanoid_simulation.backend.entities import EntityState
from humanoid_simulation.backend.mujoco_backend import MujocoBackend
from humanoid_simulation.backend.noise import SensorNoise
from humanoid_simulation.backend.settings import BackendSettings
from humanoid_simulation.backend.snapshot import Snapshot

__all__ = [
    'BackendSettings',
    'Contact',
    'EntityState',
    'MujocoBackend',
    'SensorNoise',
    'Snapshot',
]
