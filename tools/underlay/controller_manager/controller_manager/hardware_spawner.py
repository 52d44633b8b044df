# SPDX-License-Identifier: Apache-2.0
"""Program that sets the state of hardware components."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
import sys

from controller_manager._program import add_manager_arguments, node_of, parse, run
from controller_manager.controller_manager_services import (
    list_hardware_components,
    set_hardware_component_state,
)
from lifecycle_msgs.msg import State
from rclpy.node import Node

__all__ = ['main']


def main(args: Sequence[str] | None = None) -> int:
    """
    Set the state of the hardware components that the command line names.

    Parameters
    ----------
    args
        The command line, including the program name; by default that of the process.

    Returns
    -------
    int
        The exit status.

    """
    parser = argparse.ArgumentParser('hardware_spawner', description=__doc__)
    parser.add_argument(
        'hardware_component_names', nargs='+', help='names of the hardware components'
    )
    add_manager_arguments(parser)
    wanted = parser.add_mutually_exclusive_group(required=True)
    wanted.add_argument('--activate', action='store_true', help='make them active')
    wanted.add_argument('--configure', action='store_true', help='make them inactive')
    options = parse(parser, args)

    def work() -> bool:
        name = f'hardware_spawner_{options.hardware_component_names[0]}'
        with node_of(name, options.words) as node:
            return _set_states(node, options)

    return run(work)


def _set_states(node: Node, options: argparse.Namespace) -> bool:
    manager, log = options.controller_manager, node.get_logger()
    listed = list_hardware_components(
        node, manager, options.controller_manager_timeout, options.service_call_timeout
    )
    known = {each.name for each in listed.component}
    state = (
        State(id=State.PRIMARY_STATE_ACTIVE, label='active')
        if options.activate
        else State(id=State.PRIMARY_STATE_INACTIVE, label='inactive')
    )
    is_done = True
    for name in options.hardware_component_names:
        if name not in known:
            log.error(
                f"There is no hardware component '{name}'. There are: {', '.join(sorted(known))}."
            )
            is_done = False
            continue
        answer = set_hardware_component_state(
            node, manager, name, state, 0.0, options.service_call_timeout
        )
        if answer.ok and answer.state.id == state.id:
            log.info(f"The hardware component '{name}' is {state.label}")
        else:
            log.error(f"The hardware component '{name}' is {answer.state.label}")
            is_done = False
    return is_done


if __name__ == '__main__':
    sys.exit(main())
