# SPDX-License-Identifier: Apache-2.0
"""
Parameters as data: a frozen dataclass whose fields carry their description and limits.

Nothing here needs ROS; `humanoid_common.node_parameters` declares such a dataclass on a node.
"""

from __future__ import annotations

from humanoid_common.parameters.specs import parameter, ParameterRules, ParameterSpec, specs_of
from humanoid_common.parameters.values import (
    build,
    checked_value,
    ParameterError,
    ParameterValue,
    unknown_parameter_warnings,
    values_of,
    widened,
)

__all__ = [
    'ParameterError',
    'ParameterRules',
    'ParameterSpec',
    'ParameterValue',
    'build',
    'checked_value',
    'parameter',
    'specs_of',
    'unknown_parameter_warnings',
    'values_of',
    'widened',
]
