# SPDX-License-Identifier: Apache-2.0
"""What moves: robots in a simulator, or in a mock of one, behind the same interface."""

from humanoid_control.backends.interface import (
    Array,
    Backend,
    BackendError,
    ImuNoise,
    JointTargets,
    Observation,
)

__all__ = ['Array', 'Backend', 'BackendError', 'ImuNoise', 'JointTargets', 'Observation']
