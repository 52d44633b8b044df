# SPDX-License-Identifier: Apache-2.0
"""How the state of a robot, of its walk and of its simulation is worded."""

from __future__ import annotations

from dataclasses import dataclass

from robot_console.simulator_link import SILENT
from simulation_interfaces.msg import SimulationState

__all__ = ['WALKING', 'WalkingState', 'Word', 'slowness', 'words']

Word = tuple[str, str]
"""A text, and how it looks: `good`, `warn`, `bad` or `dim`."""


@dataclass(frozen=True)
class WalkingState:
    """How a state of the walk is worded."""

    label: str
    look: str
    """How the label looks, as in `Word`."""
    reason: str = ''
    """Why the robot can do nothing else, as a sentence without its full stop; '' if it can."""
    advice: str = ''
    """What to do about that before a gesture, as a sentence; '' for waiting."""


LET_STAND = 'Let it stand first.'
WALKING = {
    'stand': WalkingState('Ready', 'good'),
    'walk': WalkingState('Walking', 'good', 'The robot is walking', LET_STAND),
    'stop': WalkingState('Coming to a halt', 'good', 'The robot is walking', LET_STAND),
    'blocked': WalkingState(
        'Blocked: turn it, or walk another way', 'warn', 'An obstacle is in the way', LET_STAND
    ),
    'fallen': WalkingState('Fallen', 'bad', 'The robot has fallen', 'Stand it up first.'),
    'stand_up': WalkingState('Getting up', 'warn', 'The robot is getting up'),
}
"""The states that are published on `walking_state`."""
SIMULATION = {
    SILENT: ('The simulator does not respond', 'bad'),
    SimulationState.STATE_STOPPED: ('Paused at the start', 'warn'),
    SimulationState.STATE_PAUSED: ('Paused', 'warn'),
    SimulationState.STATE_QUITTING: ('The simulator is shutting down', 'warn'),
    SimulationState.STATE_NO_WORLD: ('No scene is loaded: choose one', 'warn'),
    SimulationState.STATE_LOADING_WORLD: ('Loading the scene', 'warn'),
}
UNKNOWN = ('The robot does not report its state', 'dim')
MATTERS = ('blocked', 'fallen', 'stand_up')
"""States of the walk that are shown beside a pause or a stop."""
SLOW = 0.5
TOO_SLOW = (
    'The simulation takes more than twice as long as reality: this computer is overloaded, or the '
    'simulation was slowed down on purpose.'
)


def words(
    walking: str | None,
    stopped: str,
    holds_because: str,
    simulation: int | None,
    can_rise: bool,
    gets_up: bool = False,
) -> list[Word]:
    """
    Describe the state of a robot, what matters most first.

    Parameters
    ----------
    walking
        The walking state; None if no node publishes it.
    stopped
        By whom or where the emergency stop was pressed; '' while it is not pressed.
    holds_because
        Why the robot holds still, as it reports; '' if it moves or does not report it.
    simulation
        The state of the simulation, as that of a `SimulatorLink`.
    can_rise
        Whether a service can stand the robot up.
    gets_up
        Whether a robot that has fallen is to get up by itself soon.

    """
    found: list[Word] = []
    if simulation in SIMULATION:
        found.append(SIMULATION[simulation])
    if stopped and holds_because:
        found.append((f'Stopped {stopped}', 'bad'))
    elif stopped:
        found.append((f'Stop pressed {stopped}; the robot has not confirmed it', 'bad'))
    elif holds_because:
        found.append((f'Holds still: {holds_because}', 'warn'))
    if walking is None:
        return found or [UNKNOWN]
    if walking in MATTERS or not found:
        state = WALKING.get(walking, WalkingState(f"Does not walk: mode '{walking}'", 'dim'))
        advice = f': {_after_fall(can_rise, gets_up)}' if walking == 'fallen' else ''
        found.append((state.label + advice, state.look))
    return found


def _after_fall(can_rise: bool, gets_up: bool) -> str:
    if gets_up:
        return f'gets up by itself in some seconds{", or press Stand up" if can_rise else ""}'
    return 'press Stand up' if can_rise else 'hold it upright'


def slowness(factor: float | None) -> str:
    """
    Explain a real-time factor that is too low; '' if it is not.

    Parameters
    ----------
    factor
        Simulated seconds per real second; None if it is unknown.

    """
    return TOO_SLOW if factor is not None and factor < SLOW else ''
