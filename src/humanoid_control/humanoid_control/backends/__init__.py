# SPDX-License-Identifier: Apache-2.0
"""Backends that move robots, simulated or mocked, behind one interface."""

from humanoid_control.backends.interface import (
    Array,
    Backend,
    BackendError,
    ImuNoise,
    JointTargets,
    Observation,
)

__all__ = ['Array', 'Backend', 'BackendError', 'ImuNoise', 'JointTargets', 'Observation']
