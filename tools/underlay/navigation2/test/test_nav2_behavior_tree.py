# SPDX-License-Identifier: Apache-2.0
"""The engine: the order of ticks of each control and decorator, scripts, subtrees, and errors."""

from __future__ import annotations

from typing import Any, ClassVar

from nav2_behavior_tree import (
    BehaviorTree,
    in_port,
    NodeStatus,
    Port,
    read_tree_text,
    register,
    TreeError,
    TreeNode,
)
from nav2_behavior_tree.model import tree_nodes_model
from nav2_behavior_tree.tree_xml import read_tree_file
import py_trees
import pytest

LETTERS = {
    'R': NodeStatus.RUNNING,
    'S': NodeStatus.SUCCESS,
    'F': NodeStatus.FAILURE,
    'K': NodeStatus.SKIPPED,
}


@register('Actor')
class Actor(TreeNode):
    """Ends as the letters of its script say, the last one for ever; notes ticks and halts."""

    ports: ClassVar[dict[str, Port]] = {'does': in_port('text', 'S', 'Letters.')}
    notes: ClassVar[list[str]] = []

    def __init__(self, config: Any) -> None:
        super().__init__(config)
        self._at = 0

    def on_tick(self) -> NodeStatus:
        Actor.notes.append(self.name)
        script = self.input('does')
        letter = script[min(self._at, len(script) - 1)]
        self._at += 1
        return LETTERS[letter]

    def on_halt(self) -> None:
        Actor.notes.append(f'-{self.name}')


class Tree:
    """A tree with a clock that a test sets."""

    def __init__(self, body: str, more: str = '') -> None:
        self.now_s = 0.0
        Actor.notes.clear()
        text = f'<root BTCPP_format="4" main_tree_to_execute="Main"><BehaviorTree ID="Main">{body}'
        self.tree = BehaviorTree.from_text(
            f'{text}</BehaviorTree>{more}</root>', lambda: self.now_s
        )
        self.board = self.tree.blackboard

    def tick(self, count: int = 1) -> str:
        """Tick; return the states as letters."""
        return ''.join(self.tree.tick().value[0] for _ in range(count))

    def take(self) -> str:
        """Return and forget what the actors did."""
        notes = ' '.join(Actor.notes)
        Actor.notes.clear()
        return notes


def actors(*scripts: str) -> str:
    """Return actors a, b, c ... with their scripts."""
    return ''.join(
        f'<Actor name="{name}" does="{script}"/>' for name, script in zip('abcdef', scripts)
    )


@pytest.mark.parametrize(
    'control, scripts, states, notes',
    [
        ('Sequence', ('S', 'RS', 'S'), 'RS', 'a b b c'),
        ('Sequence', ('S', 'F', 'S'), 'F', 'a b'),
        ('SequenceWithMemory', ('S', 'RFS', 'S'), 'RF', 'a b b'),
        ('ReactiveSequence', ('S', 'RS', 'S'), 'RS', 'a b a b c'),
        ('ReactiveSequence', ('SF', 'R'), 'RF', 'a b a -b'),
        ('Fallback', ('F', 'RS', 'S'), 'RS', 'a b b'),
        ('Fallback', ('F', 'F'), 'F', 'a b'),
        ('ReactiveFallback', ('FFS', 'R'), 'RRS', 'a b a b a -b'),
        ('Parallel', ('RS', 'RRS'), 'RRS', 'a b a b b'),
        ('Parallel', ('RF', 'R'), 'RF', 'a b a -b'),
        ('Parallel success_count="1"', ('RS', 'R'), 'RS', 'a b a -b'),
        ('Parallel failure_count="2"', ('F', 'S', 'RF'), 'F', 'a'),
        ('Parallel success_count="1" failure_count="2"', ('F', 'RS'), 'RS', 'a b b'),
        ('ParallelAll max_failures="2"', ('F', 'RS', 'S'), 'RS', 'a b c b'),
        ('ParallelAll', ('F', 'RS'), 'RF', 'a b b'),
        ('IfThenElse', ('S', 'RS', 'F'), 'RS', 'a b b'),
        ('IfThenElse', ('F', 'S', 'RS'), 'RS', 'a c c'),
        ('IfThenElse', ('F', 'S'), 'F', 'a'),
        ('WhileDoElse', ('SSF', 'R', 'S'), 'RRS', 'a b a b a -b c'),
        ('Sequence', ('K', 'S'), 'S', 'a b'),
        ('PipelineSequence', ('S', 'RRS', 'S'), 'RRS', 'a b a b a b c'),
        ('PipelineSequence', ('SRS', 'R'), 'RRR', 'a b a b a b'),
        ('PipelineSequence', ('SF', 'R'), 'RF', 'a b a -b'),
        ('NonblockingSequence', ('RS', 'S', 'RS'), 'RS', 'a b c a b c'),
        ('NonblockingSequence', ('R', 'SF'), 'RF', 'a b a b -a'),
        ('RecoveryNode number_of_retries="2"', ('FFS', 'S'), 'S', 'a b a b a'),
        ('RecoveryNode number_of_retries="1"', ('F', 'S'), 'F', 'a b a'),
        ('RecoveryNode number_of_retries="3"', ('F', 'F'), 'F', 'a b'),
        ('RecoveryNode', ('RFRS', 'RS'), 'RRRS', 'a a b b a a'),
        ('RecoveryNode number_of_retries="0"', ('F', 'S'), 'F', 'a'),
        ('RoundRobin', ('F', 'RS', 'S'), 'RS', 'a b b'),
        ('RoundRobin', ('F', 'F'), 'F', 'a b'),
    ],
)
def test_controls(control: str, scripts: tuple[str, ...], states: str, notes: str) -> None:
    """Which children are ticked and halted, and what comes out."""
    tree = Tree(f'<{control}>{actors(*scripts)}</{control.split()[0]}>')
    assert tree.tick(len(states)) == states
    assert tree.take() == notes


@pytest.mark.parametrize(
    'decorator, script, states',
    [
        ('Inverter', 'RSF', 'RFS'),
        ('ForceSuccess', 'RF', 'RS'),
        ('ForceFailure', 'RS', 'RF'),
        ('KeepRunningUntilFailure', 'SRSF', 'RRRF'),
        ('Repeat num_cycles="3"', 'S', 'S'),
        ('Repeat num_cycles="3"', 'SF', 'F'),
        ('Repeat num_cycles="2"', 'RSRS', 'RRS'),
        ('RetryUntilSuccessful num_attempts="3"', 'FFS', 'S'),
        ('RetryUntilSuccessful num_attempts="2"', 'F', 'F'),
        ('RetryUntilSuccessful num_attempts="-1"', 'FFFFFS', 'S'),
        ('RunOnce then_skip="false"', 'RFS', 'RFF'),
        ('SingleTrigger', 'RS', 'RS'),
        ("Precondition if='false' else='SUCCESS'", 'F', 'S'),
        ("Precondition if='true'", 'RS', 'RS'),
    ],
)
def test_decorators(decorator: str, script: str, states: str) -> None:
    """What becomes of the end of a child."""
    tree = Tree(f'<{decorator}>{actors(script)}</{decorator.split()[0]}>')
    assert tree.tick(len(states)) == states


@pytest.mark.parametrize('control', ['Sequence', 'Fallback', 'ReactiveSequence', 'Parallel'])
def test_a_control_is_skipped_if_all_its_children_are(control: str) -> None:
    """And is idle then."""
    tree = Tree(f'<{control}>{actors("K", "K")}</{control}>').tree
    assert tree.tick() is NodeStatus.SKIPPED and tree.root.state is NodeStatus.IDLE


def test_a_sequence_with_memory_goes_on_where_it_failed() -> None:
    """The children before it are not run again."""
    inner = f'<SequenceWithMemory>{actors("S", "FS", "S")}</SequenceWithMemory>'
    tree = Tree(f'<RetryUntilSuccessful num_attempts="2">{inner}</RetryUntilSuccessful>')
    assert tree.tick() == 'S' and tree.take() == 'a b b c'


def test_round_robin_takes_the_next_child_each_time() -> None:
    """Also after a success, as long as it is not halted."""
    body = f'<Repeat num_cycles="3"><RoundRobin>{actors("S", "S")}</RoundRobin></Repeat>'
    tree = Tree(body)
    assert tree.tick() == 'S' and tree.take() == 'a b a'


def test_switch_runs_the_case() -> None:
    """Another value stops the child that runs; the last child is for all other values."""
    body = '<Switch2 variable="{v}" case_1="1" case_2="go">' + actors('R', 'R', 'S') + '</Switch2>'
    tree = Tree(body)
    tree.board.set('v', 1)
    assert tree.tick() == 'R' and tree.take() == 'a'
    tree.board.set('v', 'go')
    assert tree.tick() == 'R' and tree.take() == '-a b'
    tree.board.set('v', 'other')
    assert tree.tick() == 'S' and tree.take() == '-b c'


def test_delay_and_timeout_go_by_the_clock_of_the_tree() -> None:
    """A child begins late, and is halted when it takes too long."""
    tree = Tree(f'<Timeout msec="1000"><Delay delay_msec="500">{actors("R")}</Delay></Timeout>')
    assert tree.tick() == 'R' and tree.take() == ''
    tree.now_s = 0.6
    assert tree.tick() == 'R' and tree.take() == 'a'
    tree.now_s = 1.1
    assert tree.tick() == 'F' and tree.take() == '-a'
    assert tree.tree.failure is not None and 'after 1 s' in tree.tree.failure.message


def test_the_rate_controller_ticks_at_first_and_once_a_period() -> None:
    """In between it is running, and what comes later in the pipeline goes on."""
    rate = f'<RateController hz="1.0">{actors("SRS")}</RateController>'
    tree = Tree(f'<PipelineSequence>{rate}<Actor name="b" does="R"/></PipelineSequence>')
    assert tree.tick(3) == 'RRR' and tree.take() == 'a b b b'
    tree.now_s = 1.0
    assert tree.tick(3) == 'RRR' and tree.take() == 'a b a b b'
    tree.now_s = 0.5
    assert tree.tick() == 'R' and tree.take() == 'a b'


def test_a_newer_goal_renews_the_tree_without_halting_it() -> None:
    """What is paced runs at once, and all retries are granted again."""
    rate = f'<RateController hz="1.0">{actors("S")}</RateController>'
    tree = Tree(f'<PipelineSequence>{rate}<Actor name="b" does="R"/></PipelineSequence>')
    assert tree.tick(2) == 'RR' and tree.take() == 'a b b'
    tree.tree.renew()
    assert tree.tick(2) == 'RR' and tree.take() == 'a b b'
    tree = Tree(f'<RecoveryNode number_of_retries="1">{actors("FRFRF", "S")}</RecoveryNode>')
    assert tree.tick() == 'R'
    tree.tree.renew()
    assert tree.tick(2) == 'RF' and tree.take() == 'a b a a b a a'


def test_a_new_goal_runs_the_child_of_the_goal_updated_controller() -> None:
    """Only then, and at first."""
    child = f'<GoalUpdatedController>{actors("S")}</GoalUpdatedController>'
    tree = Tree(f'<PipelineSequence>{child}<Actor name="b" does="R"/></PipelineSequence>')
    tree.board.set('goal', 1)
    assert tree.tick(2) == 'RR' and tree.take() == 'a b b'
    tree.board.set('goal', 2)
    assert tree.tick(2) == 'RR' and tree.take() == 'a b b'


def test_a_new_goal_ends_a_recovery() -> None:
    """Changes since the recovery began are told by GoalUpdated, not those before it."""
    tree = Tree(f'<ReactiveFallback><GoalUpdated/>{actors("R")}</ReactiveFallback>')
    tree.board.set('goal', 1)
    assert tree.tick(2) == 'RR'
    tree.board.set('goal', 2)
    assert tree.tick() == 'S' and tree.take() == 'a a -a'


def test_preconditions_and_postconditions() -> None:
    """Scripts decide whether a node runs, and what is written when it ends."""
    tree = Tree(
        '<Sequence><Script code="n := 1; text := \'x\'"/>'
        '<Actor name="a" _skipIf="n == 1"/>'
        '<Actor name="b" _successIf="n &lt; 2 &amp;&amp; true" does="F"/>'
        '<ForceSuccess><Actor name="c" _failureIf="text == \'x\'" _onFailure="n += 4"/>'
        '</ForceSuccess><Actor name="d" _onSuccess="text := text .. \'y\'" _post="n *= 2"/>'
        '<Actor name="e" does="R" _while="n == 10" _onHalted="n := -1"/></Sequence>'
    )
    assert tree.tick() == 'R' and tree.take() == 'd e'
    assert (tree.board.get('n'), tree.board.get('text')) == (10, 'xy')
    tree.board.set('n', 3)
    assert tree.tick() == 'S' and tree.take() == '-e'
    assert tree.board.get('n') == -1


@pytest.mark.parametrize(
    'script, value',
    [
        ('1 + 2 * 3', 7),
        ('(1 + 2) * 3', 9),
        ('7 / 2', 3.5),
        ('-2 - -3', 1),
        ('!(1 > 2) || false', True),
        ("1 < 2 ? 'yes' : 'no'", 'yes'),
        ("'a' .. 'b'", 'ab'),
        ('6 & 3 | 8', 10),
        ('0x10 == 16.0', True),
        ('a := b := 2', None),
    ],
)
def test_expressions(script: str, value: Any) -> None:
    """Numbers, texts, comparisons, logic."""
    if value is None:
        with pytest.raises(TreeError, match='cannot be read'):
            Tree(f'<Script code="{script}"/>')
        return
    script = script.replace('&', '&amp;').replace('<', '&lt;')
    tree = Tree(f'<Script code="r := {script}"/>')
    assert tree.tick() == 'S' and tree.board.get('r') == value


def test_scripts_tell_what_is_not_set() -> None:
    """With the place in the file."""
    tree = Tree('<Sequence>\n<ScriptCondition code="a == 1"/></Sequence>')
    with pytest.raises(TreeError, match=r":2: .*nothing has set 'a' yet"):
        tree.tick()


def test_subtrees_share_what_their_ports_say() -> None:
    """Remapped names, literals, and names that are the subtree's own."""
    tree = Tree(
        '<Sequence><SetBlackboard value="5" output_key="outer"/>'
        '<SubTree ID="Sub" inner="{outer}" word="hello" same="{=}"/></Sequence>',
        '<BehaviorTree ID="Sub"><Script code="inner += 1; w := word; same := 3; own := 1"/>'
        '</BehaviorTree>',
    )
    assert tree.tick() == 'S'
    assert (tree.board.get('outer'), tree.board.get('same')) == (6, 3)
    assert 'own' not in tree.board and 'w' not in tree.board and 'word' not in tree.board


def test_subtrees_may_share_everything() -> None:
    """With _autoremap, but for literals and names that begin with _."""
    tree = Tree(
        '<SubTree ID="Sub" _autoremap="true" word="hi"/>',
        '<BehaviorTree ID="Sub"><Script code="x := word; _mine := 2; @top := 1"/></BehaviorTree>',
    )
    assert tree.tick() == 'S'
    assert tree.board.get('x') == 'hi' and tree.board.get('top') == 1
    assert '_mine' not in tree.board and 'word' not in tree.board


def test_changes_are_noted_and_halting_makes_all_idle() -> None:
    """Each change has a time, a name, a number and two states."""
    tree = Tree(f'<Sequence name="all">{actors("S", "R")}</Sequence>')
    tree.tick()
    changes = [(each.name, each.uid, each.current.value) for each in tree.tree.take_changes()]
    assert changes == [('all', 1, 'RUNNING'), ('a', 2, 'SUCCESS'), ('b', 3, 'RUNNING')]
    tree.tree.halt()
    assert tree.take().endswith('-b')
    assert {node.state for node in tree.tree.nodes()} == {NodeStatus.IDLE}


def test_py_trees_sees_the_tree() -> None:
    """The nodes are behaviours of py_trees: its tools show and tick them."""
    tree = Tree(f'<Sequence name="all">{actors("S", "RS")}</Sequence>')
    behaviours = py_trees.trees.BehaviourTree(tree.tree.root)
    behaviours.tick()
    assert tree.tree.root.status is py_trees.common.Status.RUNNING
    shown = py_trees.display.unicode_tree(tree.tree.root, show_status=True)
    assert 'all' in shown and 'b' in shown
    tree.tree.root.stop(py_trees.common.Status.INVALID)
    assert tree.tree.root.status is py_trees.common.Status.INVALID


@pytest.mark.parametrize(
    'body, words',
    [
        ('<Sequense/>', "There is no node type 'Sequense'. Did you mean 'Sequence'?"),
        ('<Sequence/>', "'Sequence' must have at least 1 child, but has 0"),
        ('<Inverter><AlwaysSuccess/><AlwaysSuccess/></Inverter>', 'exactly 1 child'),
        ('<AlwaysSuccess><AlwaysSuccess/></AlwaysSuccess>', 'must have no children'),
        ('<RateController herz="1"><AlwaysSuccess/></RateController>', "Did you mean 'hz'?"),
        ('<RateController hz="fast"><AlwaysSuccess/></RateController>', 'must be a number'),
        ('<Repeat><AlwaysSuccess/></Repeat>', "The port 'num_cycles' of 'Repeat' is missing"),
        ('<SequenceStar><AlwaysSuccess/></SequenceStar>', "'SequenceWithMemory'"),
        ('<SubTree ID="Moin"/>', "Did you mean 'Main'?"),
        ('<SubTree ID="Main"/>', 'contains itself'),
        ('<Action/>', 'needs the attribute ID'),
        ('<AlwaysSuccess _skipIf="a ="/>', 'cannot be read'),
        ('<AlwaysSuccess _skipif="true"/>', "Did you mean '_skipIf'?"),
        ('<ManualSelector><AlwaysSuccess/></ManualSelector>', 'is not available'),
        ('<SpeedController min_rate="0"><AlwaysSuccess/></SpeedController>', 'greater than 0'),
    ],
)
def test_what_cannot_be_right_is_an_error_with_its_line(body: str, words: str) -> None:
    """Before anything runs."""
    with pytest.raises(TreeError) as caught:
        Tree(f'\n\n{body}')
    assert words in str(caught.value)
    assert caught.value.line == 3


@pytest.mark.parametrize(
    'text, words, line',
    [
        ('<root BTCPP_format="4">\n<BehaviorTree ID="A">\n</root>', 'This is not valid XML', 3),
        ('<tree/>', 'outermost element must be <root>', 1),
        ('<root BTCPP_format="3"/>', 'only format 4', 1),
        ('<root BTCPP_format="4"/>', 'There is no <BehaviorTree>', 1),
        ('<root BTCPP_format="4">\n<BehaviorTree ID="A"/></root>', 'exactly one node', 2),
        (
            '<root BTCPP_format="4" main_tree_to_execute="B">'
            '<BehaviorTree ID="A"><AlwaysSuccess/></BehaviorTree></root>',
            "main_tree_to_execute is 'B'",
            1,
        ),
        ('<root BTCPP_format="4">\n<include path="no.xml"/></root>', 'no.xml', 2),
    ],
)
def test_files_that_cannot_be_read(text: str, words: str, line: int) -> None:
    """Bad XML and bad roots are told with the line."""
    with pytest.raises(TreeError) as caught:
        read_tree_text(text)
    assert words in str(caught.value) and caught.value.line == line


def test_files_may_include_others(tmp_path: Any) -> None:
    """Their trees can be used as subtrees; models of nodes are ignored."""
    (tmp_path / 'sub.xml').write_text(
        '<root BTCPP_format="4"><BehaviorTree ID="Sub"><Action ID="Actor" name="a"/>'
        '</BehaviorTree><TreeNodesModel><Action ID="x"/></TreeNodesModel></root>'
    )
    main = tmp_path / 'main.xml'
    main.write_text(
        '<root BTCPP_format="4"><include path="sub.xml"/><BehaviorTree ID="Main">'
        '<Sub/></BehaviorTree></root>'
    )
    Actor.notes.clear()
    tree = BehaviorTree(read_tree_file(str(main)), lambda: 0.0)
    assert tree.tick() is NodeStatus.SUCCESS and Actor.notes == ['a']


@pytest.mark.parametrize(
    'node, code, state',
    [
        ('WouldAPlannerRecoveryHelp', 208, 'S'),
        ('WouldAPlannerRecoveryHelp', 308, 'S'),
        ('WouldAPlannerRecoveryHelp', 206, 'F'),
        ('WouldAPlannerRecoveryHelp', 0, 'F'),
        ('WouldAControllerRecoveryHelp', 105, 'S'),
        ('WouldAControllerRecoveryHelp', 103, 'F'),
        ('WouldASmootherRecoveryHelp', 502, 'S'),
        ('AreErrorCodesPresent error_codes_to_check="7;9"', 9, 'S'),
        ('AreErrorCodesPresent error_codes_to_check="7;9"', 8, 'F'),
    ],
)
def test_error_codes(node: str, code: int, state: str) -> None:
    """Which codes a recovery may help with."""
    tree = Tree(f'<{node} error_code="{{code}}"/>')
    tree.board.set('code', code)
    assert tree.tick() == state


def test_times_expire() -> None:
    """After each success TimeExpired begins anew; PathExpiringTimer does with a new path."""
    expired = '<TimeExpired seconds="1.0"/><PathExpiringTimer seconds="2.0"/>'
    tree = Tree(f'<ReactiveFallback>{expired}{actors("R")}</ReactiveFallback>')
    tree.board.set('path', ('a', 'path'))
    assert tree.tick(2) == 'RR'
    tree.now_s = 1.0
    assert tree.tick() == 'S'


def test_the_model_for_editors_names_all_nodes() -> None:
    """It is XML that the engine can read beside a tree."""
    text = tree_nodes_model().replace(
        '<TreeNodesModel>',
        '<BehaviorTree ID="A"><AlwaysSuccess/></BehaviorTree><TreeNodesModel>',
        1,
    )
    assert read_tree_text(text).main == 'A'
    assert '<Control ID="RecoveryNode">' in text and '<Decorator ID="RateController">' in text
    assert '<Action ID="FollowPath">' in text and '<Condition ID="GoalUpdated">' in text
