# SPDX-License-Identifier: Apache-2.0
"""When a swing foot touches the ground, when it may bear load, and when it loses that contact."""

from __future__ import annotations

from humanoid_control.walking.footing import SoleReading
from humanoid_control.walking.gait_parameters import SwingParameters
from humanoid_control.walking.swing_foot import StepClock


class Touchdown:
    """
    Touchdown of a swing foot, early or late, detected by the load on its sole.

    Parameters
    ----------
    parameters : SwingParameters
        Phases, loads and times at which the foot has touched the ground or lost it.

    Attributes
    ----------
    has_touched
        Whether the foot is on the ground; it stays there until the step ends.

    """

    def __init__(self, parameters: SwingParameters) -> None:
        self._parameters = parameters
        self.has_touched = False
        self._lost_s = 0.0

    def update(self, sole: SoleReading, clock: StepClock, passed_s: float) -> bool:
        """
        Detect the touchdown of the foot, or the loss of its contact. Call once per control period.

        Parameters
        ----------
        sole
            Measured load of the foot.
        clock
            Clock of the step.
        passed_s
            Time since the last control period.

        Returns
        -------
        bool
            Whether `has_touched` has changed.

        """
        if self.has_touched:
            self.has_touched = not self._has_lost(sole, clock, passed_s)
            return not self.has_touched
        self.has_touched = clock.is_late or self._touches(sole, clock.swing_phase)
        return self.has_touched

    def may_bear(self, sole: SoleReading, clock: StepClock) -> bool:
        """
        Check whether the foot can take the weight, or its landing is overdue.

        Parameters
        ----------
        sole
            Measured load of the foot.
        clock
            Clock of the step.

        """
        p, phase = self._parameters, clock.swing_phase
        bears = sole.load > p.touchdown_load or phase > 1.0
        return clock.is_late or (self.has_touched and phase > p.landing_phase and bears)

    def _touches(self, sole: SoleReading, phase: float) -> bool:
        """Detect contact of the descending foot with the ground."""
        p = self._parameters
        enough = p.touch_load if phase > p.gentle_phase else p.touchdown_load
        # Friction on the front of an obstacle is not ground contact.
        is_below = abs(sole.drag) < sole.load
        return phase > p.touchdown_phase and sole.load > enough and is_below

    def _has_lost(self, sole: SoleReading, clock: StepClock, passed_s: float) -> bool:
        """Check whether the foot has been without load for a while before its planned landing."""
        bears = sole.load > self._parameters.lost_load or clock.swing_phase > 1.0
        self._lost_s = 0.0 if bears else self._lost_s + passed_s
        if self._lost_s < self._parameters.lost_s:
            return False
        self._lost_s = 0.0
        return True
