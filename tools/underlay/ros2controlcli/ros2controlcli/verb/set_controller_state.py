# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 control set_controller_state`."""

from __future__ import annotations

import argparse

from ros2cli.names import closest
from ros2controlcli.manager import add_manager_arguments, ask
from ros2controlcli.verb import VerbExtension

STRICT = 2
ACTIVE, INACTIVE, UNCONFIGURED = 'active', 'inactive', 'unconfigured'


class SetControllerStateVerb(VerbExtension):
    """Adjust the state of a controller."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the controller and the state.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The name of the program, which is not used.

        """
        parser.add_argument('controller_name', help='Name of the controller to be changed')
        parser.add_argument(
            'state', choices=(INACTIVE, ACTIVE), help='State in which the controller should be'
        )
        add_manager_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Configure, activate or deactivate a controller, whatever its state needs.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed command line.

        Returns
        -------
        int, str or None
            None if the controller is in the state, else the message that says why not.

        """
        name, wanted = args.controller_name, args.state
        states = {
            each.name: each.state
            for each in ask(args, 'list_controllers', 'ListControllers').controller
        }
        if name not in states:
            known = closest(name, sorted(states)) or f'There are: {", ".join(sorted(states))}'
            return f"controller '{name}' does not seem to be loaded\n{known}"
        state = states[name]
        if state == UNCONFIGURED:
            if not ask(args, 'configure_controller', 'ConfigureController', name=name).ok:
                return f"Error configuring controller '{name}', check controller_manager logs"
            print(f'Successfully configured {name}')
            state = INACTIVE
        if state != wanted:
            answer = ask(args, 'switch_controller', 'SwitchController', **_switch(name, wanted))
            if not answer.ok:
                verb = 'activating' if wanted == ACTIVE else 'deactivating'
                return f"Error {verb} controller '{name}'. {answer.message}".rstrip()
        done = 'activated' if wanted == ACTIVE else 'deactivated'
        print(f'Successfully {done} {name}' if state != wanted else f'{name} is {wanted}')
        return None


def _switch(name: str, wanted: str) -> dict[str, object]:
    """Return the request that activates or deactivates a controller."""
    from builtin_interfaces.msg import Duration

    which = 'activate_controllers' if wanted == ACTIVE else 'deactivate_controllers'
    return {which: [name], 'strictness': STRICT, 'timeout': Duration(sec=5)}
