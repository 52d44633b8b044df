# SPDX-License-Identifier: Apache-2.0
"""Foothold adaptation to the tilt and the height of the ground."""

from __future__ import annotations

import math

from humanoid_control.walking.footing import Foothold, Footing
from humanoid_control.walking.gait_context import SoleReading
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.sides import SIDES
from humanoid_control.walking.terrain import GroundPlane


class FootholdAdaptation:
    """
    Foothold adaptation: moves footholds to the tilt and the height at which soles come to rest.

    A sole that lands tilted is rotated by the ground until it lies flat. Its target follows the
    measurement, the faster the more weight it carries: the ankle then has no stiffness against the
    ground, and the joint torques alone determine the centre of pressure. A sole in the air is not
    adapted. A foot that has touched the ground but carries too little load is pressed down.

    Parameters
    ----------
    parameters : WalkParameters
        Gait parameters, with the rates and the load thresholds of the adaptation.

    """

    def __init__(self, parameters: WalkParameters) -> None:
        self._parameters = parameters
        self._since_s = [0.0, 0.0]

    def update(
        self,
        footing: Footing,
        soles: tuple[SoleReading, SoleReading],
        shares: tuple[float, float],
        in_air: int | None,
        passed_s: float,
    ) -> None:
        """
        Adapt the footholds to the measured tilt and height of the ground.

        Parameters
        ----------
        footing
            Footholds in the odom frame; those of the feet on the ground are updated.
        soles
            Measured poses and loads of the soles, left and right, in the odom frame.
        shares
            Commanded load distribution, left and right; the sum is 1.
        in_air
            Side of the swing foot, which is not adapted; None if both feet are on the ground.
        passed_s
            Time since the last call.

        """
        for side in SIDES:
            if side == in_air:
                self._since_s[side] = 0.0
                continue
            self._since_s[side] += passed_s
            plane = self._plane(side, footing[side].plane, soles[side], shares[side], passed_s)
            footing.adapt(side, Foothold(footing.pose(side), plane))

    def _plane(
        self, side: int, told: GroundPlane, sole: SoleReading, share: float, passed_s: float
    ) -> GroundPlane:
        """Compute the adapted ground plane of a foothold."""
        p, height_m = self._parameters, told.height_m
        if share <= 0.0 and sole.load < p.swing.touchdown_load:
            height_m -= p.terrain.press_m_s * passed_s
        early = self._since_s[side] < p.terrain.adapt_early_s
        rate_1_s = p.terrain.adapt_early_1_s if early else p.terrain.adapt_1_s
        rate_1_s *= min(1.0, max(0.0, sole.load) / p.terrain.adapt_load)
        turned = 1.0 - math.exp(-rate_1_s * passed_s)
        # The base is estimated from the loaded feet: only heights of the others can be measured.
        lifted = 1.0 - math.exp(-p.terrain.adapt_height_1_s * (1.0 - share) * passed_s)
        return GroundPlane(
            height_m + lifted * (sole.plane.height_m - height_m),
            told.tilt + turned * (sole.plane.tilt - told.tilt),
        )
