# SPDX-License-Identifier: Apache-2.0
"""The smoother plugin that parameter files name nav2_constrained_smoother."""

from nav2_constrained_smoother.constrained_smoother import ConstrainedSmoother

__all__ = ['ConstrainedSmoother']
