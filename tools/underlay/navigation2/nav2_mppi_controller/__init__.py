# SPDX-License-Identifier: Apache-2.0
"""Model predictive path integral (MPPI) control, a controller plugin."""

from nav2_mppi_controller.controller import MPPIController

__all__ = ['MPPIController']
