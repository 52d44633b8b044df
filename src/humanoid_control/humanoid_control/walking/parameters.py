# SPDX-License-Identifier: Apache-2.0
"""All gait parameters, in groups of parameters that are tuned together."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.walking.disturbance_parameters import (
    BalanceParameters,
    FallParameters,
    ObstacleParameters,
    StepAdjustmentParameters,
    TerrainParameters,
)
from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.gait_parameters import (
    BodyPoseParameters,
    FootstepParameters,
    JointParameters,
    PostureParameters,
    SwingParameters,
    TimingParameters,
    VelocityParameters,
)
from humanoid_description.similarity import grown


@dataclass(frozen=True)
class WalkParameters:
    """
    Gait parameters of the robot at scale 1; `scaled` returns those of another size.

    A robot of scale s is dynamically similar: times scale with sqrt(s), lengths with s, velocities
    with sqrt(s) (Froude's law; see humanoid_description/config/scaling.yaml for details).
    """

    timing: TimingParameters = TimingParameters()
    footsteps: FootstepParameters = FootstepParameters()
    velocity: VelocityParameters = VelocityParameters()
    posture: PostureParameters = PostureParameters()
    body_pose: BodyPoseParameters = BodyPoseParameters()
    balance: BalanceParameters = BalanceParameters()
    step_adjustment: StepAdjustmentParameters = StepAdjustmentParameters()
    swing: SwingParameters = SwingParameters()
    terrain: TerrainParameters = TerrainParameters()
    fall: FallParameters = FallParameters()
    obstacles: ObstacleParameters = ObstacleParameters()
    joints: JointParameters = JointParameters()

    def scaled(self, scale: float) -> WalkParameters:
        """
        Scale the gait parameters to a robot of another size (Froude similarity).

        Parameters
        ----------
        scale
            Size of that robot, relative to the one of these parameters.

        Returns
        -------
        WalkParameters
            Gait parameters of that robot; these are not modified.

        Raises
        ------
        WalkingError
            The scale is not positive and finite.

        """
        if not (0.0 < scale < float('inf')):
            raise WalkingError(f'The scale {scale:g} is not a size. Give one as 0.65.')
        return grown(self, scale)
