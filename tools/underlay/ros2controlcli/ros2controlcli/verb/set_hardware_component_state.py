# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 control set_hardware_component_state`."""

from __future__ import annotations

import argparse

from ros2controlcli.manager import add_manager_arguments, connected, unknown
from ros2controlcli.states import ACTIVE, INACTIVE, see_log, UNCONFIGURED
from ros2controlcli.verb import VerbExtension


class SetHardwareComponentStateVerb(VerbExtension):
    """Adjust the state of a hardware component."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the component and the state.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The name of the program, which is not used.

        """
        parser.add_argument(
            'hardware_component_name', help='Name of the hardware component to be changed'
        )
        parser.add_argument(
            'state',
            choices=(UNCONFIGURED, INACTIVE, ACTIVE),
            help='State in which the hardware component should be',
        )
        add_manager_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Bring a hardware component to a state.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed command line.

        Returns
        -------
        int, str or None
            None if it is in the state, else the message that says why not.

        """
        name, wanted = args.hardware_component_name, args.state
        with connected(args) as manager:
            components = manager.ask('list_hardware_components').component
            if name not in {each.name for each in components}:
                return unknown('hardware component', name, [each.name for each in components])
            answer = manager.ask('set_hardware_component_state', name, _state(wanted))
            if not answer.ok or answer.state.label != wanted:
                return (
                    f"Error setting hardware component '{name}' to {wanted}: it is "
                    f'{answer.state.label or "in an unknown state"}. {see_log(manager)}'
                )
        print(f'Successfully set {name} to {answer.state.label}')
        return None


def _state(label: str) -> object:
    """Build the `lifecycle_msgs/State` of a label."""
    from lifecycle_msgs.msg import State

    number = {
        UNCONFIGURED: State.PRIMARY_STATE_UNCONFIGURED,
        INACTIVE: State.PRIMARY_STATE_INACTIVE,
        ACTIVE: State.PRIMARY_STATE_ACTIVE,
    }[label]
    return State(id=number, label=label)
