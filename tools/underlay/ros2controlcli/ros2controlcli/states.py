# SPDX-License-Identifier: Apache-2.0
"""Bring a controller to a state, and say why a controller manager has refused it."""

from __future__ import annotations

from ros2controlcli.manager import Manager, unknown

ACTIVE, INACTIVE, UNCONFIGURED = 'active', 'inactive', 'unconfigured'
SWITCH_TIMEOUT_S = 5.0


def bring(manager: Manager, name: str, wanted: str) -> str:
    """
    Configure, activate or deactivate a controller as its state needs, and print what is done.

    Parameters
    ----------
    manager
        The controller manager.
    name
        The name of the controller.
    wanted
        The state: ACTIVE or INACTIVE.

    Returns
    -------
    str
        The reason why it is not in that state; '' if it is.

    """
    states = manager.states()
    if name not in states:
        load = f'ros2 control load_controller {name}'
        return f'{unknown("controller", name, states)}\nTo load one: {load}'
    state = states[name]
    if state == UNCONFIGURED:
        if not manager.ask('configure_controller', name).ok:
            return f"Error configuring controller '{name}'. {see_log(manager)}"
        print(f'Successfully configured {name}')
        state = INACTIVE
    if state == wanted:
        print(f'{name} is {wanted}')
        return ''
    activated, deactivated = ([name], []) if wanted == ACTIVE else ([], [name])
    answer = manager.ask(
        'switch_controllers', deactivated, activated, True, False, SWITCH_TIMEOUT_S
    )
    if not answer.ok:
        verb = 'activating' if wanted == ACTIVE else 'deactivating'
        return f"Error {verb} controller '{name}'. {answer.message or see_log(manager)}"
    print(f'Successfully {"activated" if wanted == ACTIVE else "deactivated"} {name}')
    return ''


def see_log(manager: Manager) -> str:
    """
    Build the sentence about where the reason of a refusal is: the response has none.

    Parameters
    ----------
    manager
        The controller manager.

    """
    return f"The log of the controller manager '{manager.name}' says why"
