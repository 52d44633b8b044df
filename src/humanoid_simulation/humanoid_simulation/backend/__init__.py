# SPDX-License-Identifier: Apache-2.0
"""MuJoCo simulation as a backend of the controllers."""

from humanoid_simulation.backend.forces import Contact
from humanoid_simulation.backend.mujoco_backend import MujocoBackend
from humanoid_simulation.backend.noise import SensorNoise
from humanoid_simulation.backend.settings import BackendSettings
from humanoid_simulation.backend.state import EntityState, Snapshot

__all__ = [
    'BackendSettings',
    'Contact',
    'EntityState',
    'MujocoBackend',
    'SensorNoise',
    'Snapshot',
]
