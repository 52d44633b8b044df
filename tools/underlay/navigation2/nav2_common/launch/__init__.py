# SPDX-License-Identifier: Apache-2.0
"""Substitutions that modify parameter files for a launch."""

from nav2_common.launch.parameter_files import HasNodeParams, ReplaceString, RewrittenYaml
from nav2_common.launch.robot_poses import ParseMultiRobotPose

__all__ = ['HasNodeParams', 'ParseMultiRobotPose', 'ReplaceString', 'RewrittenYaml']
