# SPDX-License-Identifier: Apache-2.0
"""The state of a robot in words, and which simulator its buttons are for."""

from __future__ import annotations

import pytest
from robot_console.control import stopped_by
from robot_console.simulator_link import choose_simulator, failure_of, simulators_among
from robot_console.state_words import slowness, words
from simulation_interfaces.msg import Result, SimulationState
from simulation_interfaces.srv import ResetSimulation
from std_srvs.srv import Trigger

PLAYING, PAUSED = SimulationState.STATE_PLAYING, SimulationState.STATE_PAUSED


@pytest.mark.parametrize(
    ('walking', 'stopped', 'holds', 'simulation', 'said'),
    [
        ('stand', '', '', None, 'Ready'),
        ('walk', '', '', PLAYING, 'Walking'),
        ('fallen', '', '', PLAYING, 'Fallen: press Stand up'),
        ('stand', '', '', PAUSED, 'Paused'),
        ('stand', 'by ann', 'the emergency stop is pressed', PLAYING, 'Stopped by ann'),
        ('stand', '', 'the console is lost', PLAYING, 'Holds still: the console is lost'),
        ('fallen', 'by ann', 'it fell', PAUSED, 'Paused; Stopped by ann; Fallen: press Stand up'),
        ('swing', '', '', None, "Does not walk: mode 'swing'"),
        (None, '', '', PLAYING, 'The robot does not report its state'),
        (None, 'by ann', '', None, 'Stop pressed by ann; the robot has not confirmed it'),
    ],
)
def test_words(
    walking: str | None, stopped: str, holds: str, simulation: int | None, said: str
) -> None:
    """What keeps a robot from moving comes first; nothing of it is left out."""
    found = words(walking, stopped, holds, simulation, True)
    assert '; '.join(text for text, _ in found) == said


def test_a_fallen_robot_that_no_service_can_lift() -> None:
    """A person has to do it, so no button is named."""
    ((text, look),) = words('fallen', '', '', None, False)
    assert (text, look) == ('Fallen: hold it upright', 'bad')


def test_a_fallen_robot_that_gets_up_by_itself() -> None:
    """Nobody has to do anything, but may lift it at once where a service can."""
    waits = 'Fallen: gets up by itself in some seconds'
    assert words('fallen', '', '', None, False, True) == [(waits, 'bad')]
    assert words('fallen', '', '', None, True, True) == [(f'{waits}, or press Stand up', 'bad')]
    assert words('stand', '', '', None, True, True) == [('Ready', 'good')]


def test_stopped_by() -> None:
    """A user is told in which browser it was, or the other nodes that publish, not too many."""
    ann, ben, eve = 'browser 1 (10.0.0.1)', 'browser 2 (10.0.0.1)', 'browser 3 (10.0.0.3)'
    assert stopped_by(ann, ann, {'/a'}) == 'in this page'
    assert stopped_by(ben, ann, {'/a'}) == 'in another browser'
    assert stopped_by(eve, ann, {'/a'}) == 'in a browser at 10.0.0.3'
    assert stopped_by('', ann, {'/b', '/a'}) == 'by /a, /b'
    assert stopped_by('', ann, set('/abcd')) == 'by /, a, b and 2 more'
    assert stopped_by('', ann, set()) == 'by someone who has left'


@pytest.mark.parametrize(('factor', 'is_slow'), [(None, False), (0.49, True), (0.5, False)])
def test_slowness(factor: float | None, is_slow: bool) -> None:
    """Half of real time is where a sentence appears."""
    assert bool(slowness(factor)) is is_slow


def test_simulators_among() -> None:
    """A simulator is known by names and types of its services."""
    reset = ['simulation_interfaces/srv/ResetSimulation']
    services = [
        ('/simulator/reset_simulation', reset),
        ('/simulator/load_world', ['simulation_interfaces/srv/LoadWorld']),
        ('/simulator/spawn_entity', ['simulation_interfaces/srv/SpawnEntity']),
        ('/reset_simulation', reset),
        ('/other/reset_simulation', ['std_srvs/srv/Trigger']),
    ]
    assert simulators_among(services) == {
        '/simulator': {'reset_simulation', 'load_world'},
        '': {'reset_simulation'},
    }


def test_choose_simulator() -> None:
    """The only one, the one of the robot, or the one that the user names."""
    assert choose_simulator(['/a'], '', '') == '/a'
    assert choose_simulator([''], '', 'robot1') == ''
    assert choose_simulator(['/a', '/robot1/a'], '', 'robot1') == '/robot1/a'
    assert choose_simulator(['/a', '/b'], '/b', '') == '/b'
    for found, wanted, reason in (
        ([], '', 'No simulator is running'),
        (['/b', '/a'], '', 'several simulators: /a, /b. Name one'),
        (['/a'], '/b', "'/b' is not running"),
    ):
        with pytest.raises(ValueError, match=reason):
            choose_simulator(found, wanted, 'robot1')


def test_failure_of() -> None:
    """A rejection has a reason, also where the service gives none."""
    assert failure_of(Trigger.Response(success=True, message='done')) == ''
    assert failure_of(Trigger.Response(message='no')) == 'no'
    response = ResetSimulation.Response()
    assert failure_of(response) == 'The request was rejected without a reason.'
    response.result = Result(result=Result.RESULT_OPERATION_FAILED, error_message='no')
    assert failure_of(response) == 'no'
    response.result.result = Result.RESULT_OK
    assert failure_of(response) == ''
