# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 control`."""

from __future__ import annotations

from ros2cli.command import VerbCommand
from ros2cli.entry import Entry


class ControlCommand(VerbCommand):
    """Various control related sub-commands."""

    VERB_GROUP = 'ros2controlcli.verb'
    VERBS = {
        'list_controller_types': Entry(
            'ros2controlcli.verb.list_controller_types:ListControllerTypesVerb',
            'List controller types and their base classes',
        ),
        'list_controllers': Entry(
            'ros2controlcli.verb.list_controllers:ListControllersVerb',
            'List controllers, their types and states',
        ),
        'list_hardware_components': Entry(
            'ros2controlcli.verb.list_hardware_components:ListHardwareComponentsVerb',
            'List hardware components',
        ),
        'list_hardware_interfaces': Entry(
            'ros2controlcli.verb.list_hardware_interfaces:ListHardwareInterfacesVerb',
            'List command and state interfaces',
        ),
        'set_controller_state': Entry(
            'ros2controlcli.verb.set_controller_state:SetControllerStateVerb',
            'Adjust the state of a controller',
        ),
        'switch_controllers': Entry(
            'ros2controlcli.verb.switch_controllers:SwitchControllersVerb',
            'Switch controllers in a controller manager',
        ),
    }
