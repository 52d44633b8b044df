# SPDX-License-Identifier: Apache-2.0
"""The lifecycle manager with nodes that note what is done to them, fail, vanish and come back."""

from __future__ import annotations

from typing import Any

from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetState
from nav2_lifecycle_manager import LifecycleManager
from nav2_msgs.srv import ManageLifecycleNodes
from nav2_util import ConfigurationError, LifecycleNode
import pytest
from std_srvs.srv import Trigger

NAMES = ['one', 'two', 'three', 'four']
Request = ManageLifecycleNodes.Request


class Server(LifecycleNode):
    """Notes its transitions; fails where it is told to."""

    def __init__(self, node_name: str, notes: list[str], **options: Any) -> None:
        super().__init__(node_name, **options)
        self.notes, self.fails_at = notes, ''

    def _note(self, what: str) -> None:
        if what == self.fails_at:
            raise ConfigurationError(f'It cannot {what}.')
        self.notes.append(f'{what} {self.get_name()}')

    def configure(self) -> None:
        """Note it."""
        self._note('configure')

    def activate(self) -> None:
        """Note it."""
        self._note('activate')

    def deactivate(self) -> None:
        """Note it."""
        self._note('deactivate')

    def cleanup(self) -> None:
        """Note it."""
        self._note('cleanup')


class Rig:
    """Servers and their manager."""

    def __init__(self, ros: Any, **parameters: Any) -> None:
        self.ros, self.notes = ros, []
        ros.node()
        self.servers = {name: self.make(name) for name in NAMES}
        told = {'node_names': NAMES, 'bond_timeout': 0.4, 'service_timeout': 1.0, **parameters}
        self.manager = ros.make(LifecycleManager, told)

    def make(self, name: str) -> Any:
        """Make a server."""
        return self.ros.add(Server(name, self.notes, context=self.ros.context))

    def remove(self, name: str) -> None:
        """Let a server vanish."""
        node = self.servers.pop(name)
        self.ros.nodes.remove(node)
        self.ros.executor.remove_node(node)
        self.ros.spin(0.05)
        node.destroy_node()

    def command(self, number: int) -> bool:
        """Give a command; return whether it went well."""
        name = '/lifecycle_manager/manage_nodes'
        return self.ros.call(ManageLifecycleNodes, name, Request(command=number)).success

    @property
    def is_active(self) -> bool:
        """Return what the manager says."""
        return self.ros.call(Trigger, '/lifecycle_manager/is_active').success

    def states(self) -> set[str]:
        """Return the states of the servers."""
        return {node.state for node in self.servers.values()}

    def taken(self) -> list[str]:
        """Return what was noted since the last call."""
        notes = list(self.notes)
        self.notes.clear()
        return notes


@pytest.fixture
def rig(ros):
    """Manage four servers."""
    return Rig(ros)


def _in_order(*what: str, names: list[str] = NAMES) -> list[str]:
    return [f'{each} {name}' for each in what for name in names]


def test_up_and_down(rig):
    """Up in order, down in the opposite one; an answer comes when it is done."""
    assert not rig.is_active
    assert rig.command(Request.STARTUP)
    assert rig.taken() == _in_order('configure', 'activate')
    assert rig.is_active and rig.states() == {'active'}
    back = NAMES[::-1]
    assert rig.command(Request.PAUSE)
    assert rig.taken() == _in_order('deactivate', names=back)
    assert not rig.is_active
    assert rig.command(Request.RESUME)
    assert rig.taken() == _in_order('activate')
    assert rig.command(Request.RESET)
    assert rig.taken() == _in_order('deactivate', 'cleanup', names=back)
    assert rig.states() == {'unconfigured'}
    assert rig.command(Request.CONFIGURE)
    assert rig.taken() == _in_order('configure') and not rig.is_active
    assert rig.command(Request.CLEANUP)
    assert rig.taken() == _in_order('cleanup', names=back)
    assert rig.command(Request.STARTUP)
    rig.taken()
    assert rig.command(Request.SHUTDOWN)
    ends = [f'{each} {name}' for name in back for each in ('deactivate', 'cleanup')]
    assert rig.taken() == ends and rig.states() == {'finalized'}
    assert not rig.is_active
    assert not rig.command(Request.STARTUP)  # there is no way back from the end


def test_ten_times(rig):
    """It is as good the tenth time as the first."""
    for _ in range(10):
        assert rig.command(Request.STARTUP) and rig.states() == {'active'}
        assert rig.command(Request.RESET) and rig.states() == {'unconfigured'}


def test_started_twice(rig):
    """What is done already is left out."""
    assert rig.command(Request.STARTUP)
    rig.taken()
    assert rig.command(Request.STARTUP)
    assert rig.taken() == [] and rig.is_active


def test_autostart(ros):
    """Nodes are brought up without being asked for."""
    rig = Rig(ros, autostart=True)
    ros.wait_until(lambda: rig.manager.is_active)
    assert rig.states() == {'active'}


@pytest.mark.parametrize('step', ['configure', 'activate'])
def test_third_node_fails(rig, capfd, step):
    """The rest is not brought up, the log says who failed; a second try goes on from there."""
    rig.servers['three'].fails_at = step
    assert not rig.command(Request.STARTUP)
    assert f'{step} four' not in rig.taken()
    assert not rig.is_active
    said = capfd.readouterr().err
    assert 'Failed to bring up all requested nodes' in said and "'three'" in said
    assert f'It cannot {step}.' in said
    rig.servers['three'].fails_at = ''
    assert rig.command(Request.STARTUP) and rig.states() == {'active'}


def test_node_that_comes_late(ros):
    """It is waited for."""
    rig = Rig(ros, autostart=True, node_names=[*NAMES, 'late'])
    ros.spin(0.3)
    assert not rig.manager.is_active
    rig.servers['late'] = rig.make('late')
    ros.wait_until(lambda: rig.manager.is_active)


def test_node_that_vanishes_and_comes_back(rig):
    """The others are brought down at once, and all are brought up when it is there again."""
    assert rig.command(Request.STARTUP)
    rig.taken()
    rig.remove('two')
    rig.ros.wait_until(lambda: not rig.manager.is_active, what='the end of the others')
    rig.ros.wait_until(lambda: rig.states() == {'unconfigured'})
    rig.servers['two'] = rig.make('two')
    rig.ros.wait_until(lambda: rig.manager.is_active, what='the stack')
    assert rig.states() == {'active'}


def test_node_that_stays_away(ros):
    """After a time it is given up, with an error; the manager goes on."""
    rig = Rig(ros, bond_respawn_max_duration=0.3)
    assert rig.command(Request.STARTUP)
    rig.remove('two')
    ros.wait_until(lambda: rig.states() == {'unconfigured'})
    ros.wait_until(lambda: not rig.manager._is_busy, what='the end of the wait')
    assert not rig.is_active
    rig.servers['two'] = rig.make('two')
    assert rig.command(Request.STARTUP) and rig.is_active


def test_without_reconnection(ros):
    """A stack that is not to come back stays down."""
    rig = Rig(ros, attempt_respawn_reconnection=False)
    assert rig.command(Request.STARTUP)
    rig.remove('one')
    ros.wait_until(lambda: rig.states() == {'unconfigured'})
    rig.servers['one'] = rig.make('one')
    ros.spin(1.0)
    assert rig.states() == {'unconfigured'} and not rig.is_active


def test_node_that_somebody_deactivates(rig):
    """The stack is brought up anew."""
    assert rig.command(Request.STARTUP)
    rig.servers['three'].trigger_deactivate()
    rig.taken()
    rig.ros.wait_until(lambda: 'activate four' in rig.notes)
    rig.ros.wait_until(lambda: rig.manager.is_active)
    assert rig.states() == {'active'}


def test_no_watch(ros):
    """With a bond_timeout of 0 nobody looks after the nodes."""
    rig = Rig(ros, bond_timeout=0.0)
    assert rig.command(Request.STARTUP)
    rig.remove('two')
    ros.spin(1.0)
    assert rig.is_active


def test_node_that_never_answers(ros, capfd):
    """It is an error after service_timeout; the manager goes on."""
    rig = Rig(ros, node_names=[*NAMES, 'deaf'])
    deaf = ros.node('deaf')
    deaf.create_service(GetState, 'deaf/get_state', lambda *_: None).send_response = lambda *_: 0
    deaf.create_service(ChangeState, 'deaf/change_state', lambda *_: None)
    assert not rig.command(Request.STARTUP)
    assert "'deaf' did not report its state within 1 s." in capfd.readouterr().err
    assert rig.command(Request.RESET) is False and not rig.is_active


def test_commands_while_busy(ros):
    """A second command is refused while the first is at work."""
    rig = Rig(ros, node_names=[*NAMES, 'late'])
    node = ros.nodes[0]
    client = node.create_client(ManageLifecycleNodes, '/lifecycle_manager/manage_nodes')
    ros.wait_until(client.service_is_ready)
    first = client.call_async(Request(command=Request.STARTUP))
    ros.wait_until(lambda: rig.manager._is_busy)
    assert not rig.command(Request.RESET)
    assert not first.done()
    rig.servers['late'] = rig.make('late')
    ros.wait_until(first.done)
    assert first.result().success and rig.is_active
    node.destroy_client(client)


@pytest.mark.parametrize('wanted', [{'id': 3}, {'id': 250}, {'label': 'dance'}])
def test_transition_that_is_not_possible(ros, capfd, wanted):
    """It is refused, and the node goes on."""
    ros.make(Server, node_name='one', notes=[])
    request = ChangeState.Request(transition=Transition(**wanted))
    assert not ros.call(ChangeState, '/one/change_state', request).success
    assert ros.call(GetState, '/one/get_state').current_state.label == 'unconfigured'


def test_unknown_command(rig):
    """It is refused."""
    assert not rig.command(99)


def test_wrong_parameter(ros):
    """A manager that cannot work with what it is told says why."""
    with pytest.raises(ConfigurationError, match="'bond_timeout' must be at least 0"):
        ros.make(LifecycleManager, {'bond_timeout': -1.0})


def test_parameters_without_effect(ros, capfd):
    """What genuine servers have for bonds is accepted; bringing itself up is not possible."""
    given = {'bond_heartbeat_period': 0.25, 'autostart_node': True}
    node = ros.make(Server, given, node_name='one', notes=[])
    node.trigger_configure()
    said = capfd.readouterr().err
    assert 'bond_heartbeat_period' not in said
    assert "'autostart_node' has no effect: the lifecycle manager" in said
