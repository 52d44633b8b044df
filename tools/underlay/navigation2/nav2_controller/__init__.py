# SPDX-License-Identifier: Apache-2.0
"""The controller server, and the interfaces of its plugins."""

from nav2_controller.checkers import GoalChecker, ProgressChecker
from nav2_controller.control import Command, Controller, ControlState, NoValidControl
from nav2_controller.controller_server import ControllerServer
from nav2_controller.plugins import PluginContext

__all__ = [
    'Command',
    'ControlState',
    'Controller',
    'ControllerServer',
    'GoalChecker',
    'NoValidControl',
    'PluginContext',
    'ProgressChecker',
]
