# SPDX-License-Identifier: Apache-2.0
"""Program that loads, configures and activates controllers, as far as they are not yet."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
import sys
import time

from controller_manager._program import add_manager_arguments, node_of, parse, run
from controller_manager.controller_manager_services import (
    configure_controller,
    list_controllers,
    load_controller,
    set_controller_parameters,
    set_controller_parameters_from_param_files,
    switch_controllers,
    unload_controller,
)
from rclpy.node import Node

__all__ = ['main']


def main(args: Sequence[str] | None = None) -> int:
    """
    Spawn the controllers that the command line names.

    Parameters
    ----------
    args
        The command line, including the program name; by default that of the process.

    Returns
    -------
    int
        The exit status.

    """
    options = parse(_parser(), args)

    def work() -> bool:
        with node_of(f'spawner_{options.controller_names[0]}', options.words) as node:
            return Spawner(node, options).run()

    return run(work)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser('spawner', description=__doc__)
    parser.add_argument('controller_names', nargs='+', help='names of the controllers')
    add_manager_arguments(parser)
    parser.add_argument(
        '-p',
        '--param-file',
        action='append',
        metavar='FILE',
        help='file with parameters of the controllers, among them their types; may be repeated',
    )
    parser.add_argument(
        '--load-only', action='store_true', help='only load them, and leave them unconfigured'
    )
    parser.add_argument(
        '--inactive', action='store_true', help='load and configure them, but do not activate them'
    )
    parser.add_argument(
        '-u',
        '--unload-on-kill',
        action='store_true',
        help='wait until this program is interrupted, then deactivate and unload them',
    )
    parser.add_argument(
        '--activate-as-group',
        action='store_true',
        help='activate all of them in one step, or none',
    )
    parser.add_argument(
        '--controller-ros-args',
        action='append',
        metavar='ARGUMENTS',
        help="arguments of ROS for the controllers' nodes, such as '-r a:=b'; may be repeated",
    )
    return parser


class Spawner:
    """
    Brings controllers to the state that was asked for, whatever state they are in.

    Parameters
    ----------
    node
        The node that calls the controller manager.
    options
        The options of the program.

    """

    def __init__(self, node: Node, options: argparse.Namespace) -> None:
        self._node, self._options = node, options
        self._log = node.get_logger()
        self._manager: str = options.controller_manager
        self._call_s: float = options.service_call_timeout
        self._names: list[str] = options.controller_names

    def run(self) -> bool:
        """Spawn the controllers; return whether all are in the state that was asked for."""
        states = self._states(self._options.controller_manager_timeout)
        for name in self._names:
            if not self._prepare(name, states.get(name)):
                return False
        if not (self._options.load_only or self._options.inactive) and not self._activate():
            return False
        if self._options.unload_on_kill:
            self._wait_and_unload()
        return True

    def _states(self, timeout_s: float = 0.0) -> dict[str, str]:
        answer = list_controllers(self._node, self._manager, timeout_s, self._call_s)
        return {each.name: each.state for each in answer.controller}

    def _prepare(self, name: str, state: str | None) -> bool:
        """Load and configure a controller, as far as it is not; return whether that is done."""
        if state is not None:
            self._log.info(f"The controller '{name}' is loaded already")
        elif not self._load(name):
            return False
        if self._options.load_only or state in ('inactive', 'active'):
            return True
        if configure_controller(self._node, self._manager, name, 0.0, self._call_s).ok:
            self._log.info(f"Configured the controller '{name}'")
            return True
        return self._fail(f"The controller '{name}' cannot be configured")

    def _load(self, name: str) -> bool:
        if not self._tell_parameters(name):
            return False
        answer = load_controller(self._node, self._manager, name, 0.0, self._call_s)
        # The answer to a request may be lost, and the next one fails as it is loaded.
        if answer.ok or name in self._states():
            self._log.info(f"Loaded the controller '{name}'")
            return True
        return self._fail(f"The controller '{name}' cannot be loaded")

    def _tell_parameters(self, name: str) -> bool:
        """Tell the manager the parameters of a controller before it loads it."""
        words = [word for each in self._options.controller_ros_args or () for word in each.split()]
        return set_controller_parameters(
            self._node, self._manager, name, 'node_options_args', words
        ) and (
            not self._options.param_file
            or set_controller_parameters_from_param_files(
                self._node, self._manager, name, self._options.param_file
            )
        )

    def _activate(self) -> bool:
        states = self._states()
        waiting = [name for name in self._names if states.get(name) != 'active']
        groups = [waiting] if self._options.activate_as_group else [[name] for name in waiting]
        for group in filter(None, groups):
            answer = switch_controllers(
                self._node,
                self._manager,
                deactivate_controllers=[],
                activate_controllers=group,
                strict=True,
                activate_asap=True,
                timeout=self._options.switch_timeout,
                call_timeout=self._call_s,
            )
            named = ', '.join(group)
            if not answer.ok:
                return self._fail(f'Not activated: {named}. {answer.message}'.rstrip())
            self._log.info(f'Activated: {named}')
        return True

    def _wait_and_unload(self) -> None:
        """Wait for a signal, then deactivate and unload the controllers."""
        self._log.info('Waiting for an interrupt, to unload the controllers')
        try:
            while True:
                time.sleep(1.0)
        except KeyboardInterrupt:
            self._log.info('Interrupted: the controllers are unloaded')
        unload(self._node, self._options)

    def _fail(self, reason: str) -> bool:
        self._log.error(f"{reason}. The log of the controller manager '{self._manager}' says why.")
        return False


def unload(node: Node, options: argparse.Namespace) -> bool:
    """
    Deactivate controllers, and unload them.

    Parameters
    ----------
    node
        The node that calls the controller manager.
    options
        The options of the program.

    Returns
    -------
    bool
        Whether all of them are gone; errors are logged.

    """
    manager, log = options.controller_manager, node.get_logger()
    listed = list_controllers(
        node, manager, options.controller_manager_timeout, options.service_call_timeout
    )
    states = {each.name: each.state for each in listed.controller}
    active = [name for name in options.controller_names if states.get(name) == 'active']
    if active:
        answer = switch_controllers(
            node,
            manager,
            deactivate_controllers=active,
            activate_controllers=[],
            strict=True,
            activate_asap=True,
            timeout=options.switch_timeout,
            call_timeout=options.service_call_timeout,
        )
        if not answer.ok:
            log.error(f'Not deactivated: {", ".join(active)}. {answer.message}'.rstrip())
            return False
        log.info(f'Deactivated: {", ".join(active)}')
    is_done = True
    for name in options.controller_names:
        if name not in states:
            log.warning(f"The controller '{name}' is not loaded")
        elif unload_controller(node, manager, name, 0.0, options.service_call_timeout).ok:
            log.info(f"Unloaded the controller '{name}'")
        else:
            log.error(f"The controller '{name}' cannot be unloaded")
            is_done = False
    return is_done


if __name__ == '__main__':
    sys.exit(main())
