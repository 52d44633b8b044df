# SPDX-License-Identifier: Apache-2.0
"""Regulated pure pursuit, a controller plugin."""

from nav2_regulated_pure_pursuit_controller.controller import RegulatedPurePursuitController

__all__ = ['RegulatedPurePursuitController']
