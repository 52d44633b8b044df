# SPDX-License-Identifier: Apache-2.0
"""The trajectory generators of DWB."""

from dwb_plugins.generators import LimitedAccelGenerator, StandardTrajectoryGenerator

__all__ = ['LimitedAccelGenerator', 'StandardTrajectoryGenerator']
