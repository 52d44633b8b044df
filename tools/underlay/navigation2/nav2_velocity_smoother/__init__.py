# SPDX-License-Identifier: Apache-2.0
"""Smooths velocity commands within limits of speed and acceleration."""

from nav2_velocity_smoother.smoothing import Limits, OdometryAverage, smooth
from nav2_velocity_smoother.velocity_smoother import VelocitySmoother

__all__ = ['Limits', 'OdometryAverage', 'VelocitySmoother', 'smooth']
