# SPDX-License-Identifier: Apache-2.0
"""The actions that know about ROS."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch._lazy import lazy_exports

if TYPE_CHECKING:
    from .node import Node
    from .push_ros_namespace import PushROSNamespace
    from .push_ros_namespace import PushRosNamespace
    from .set_parameter import SetParameter
    from .set_parameters_from_file import SetParametersFromFile
    from .set_remap import SetRemap
    from .set_ros_log_dir import SetROSLogDir
    from .set_use_sim_time import SetUseSimTime

__all__ = [
    'Node',
    'PushROSNamespace',
    'PushRosNamespace',
    'SetParameter',
    'SetParametersFromFile',
    'SetROSLogDir',
    'SetRemap',
    'SetUseSimTime',
]

__getattr__, __dir__ = lazy_exports(__name__, __all__)
