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
        'load_controller': Entry(
            'ros2controlcli.verb.load_controller:LoadControllerVerb',
            'Load a controller in a controller manager',
        ),
        'reload_controller_libraries': Entry(
            'ros2controlcli.verb.reload_controller_libraries:ReloadControllerLibrariesVerb',
            'Reload controller libraries',
        ),
        'set_controller_state': Entry(
            'ros2controlcli.verb.set_controller_state:SetControllerStateVerb',
            'Adjust the state of a controller',
        ),
        'set_hardware_component_state': Entry(
            'ros2controlcli.verb.set_hardware_component_state:SetHardwareComponentStateVerb',
            'Adjust the state of a hardware component',
        ),
        'switch_controllers': Entry(
            'ros2controlcli.verb.switch_controllers:SwitchControllersVerb',
            'Switch controllers in a controller manager',
        ),
        'unload_controller': Entry(
            'ros2controlcli.verb.unload_controller:UnloadControllerVerb',
            'Unload a controller in a controller manager',
        ),
        'view_controller_chains': Entry(
            'ros2controlcli.verb.view_controller_chains:ViewControllerChainsVerb',
            'Draw the loaded controllers and their chains',
        ),
    }
