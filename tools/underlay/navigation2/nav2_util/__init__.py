# SPDX-License-Identifier: Apache-2.0
"""Utilities that the navigation servers share."""

from nav2_util.actions import ActionServer, GoalCanceled
from nav2_util.errors import ActionAborted, ConfigurationError, NavigationError
from nav2_util.geometry import Pose2D
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import parameter, ParameterSet
from nav2_util.timing import Rate, sleep
from nav2_util.transforms import TransformError, Transforms

__all__ = [
    'ActionAborted',
    'ActionServer',
    'ConfigurationError',
    'GoalCanceled',
    'LifecycleNode',
    'NavigationError',
    'ParameterSet',
    'Pose2D',
    'Rate',
    'TransformError',
    'Transforms',
    'parameter',
    'sleep',
]
