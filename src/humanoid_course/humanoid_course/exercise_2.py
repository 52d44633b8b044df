# SPDX-License-Identifier: Apache-2.0
"""Exercise 2: a launch file that starts the same controller for three robots."""

from __future__ import annotations

from humanoid_course import common_checks as common
from humanoid_course.common_checks import Check
from humanoid_course.grading import Exercise, failed, passed, Verdict
from humanoid_course.observations import FIRST_MESSAGES, Run, Submission
from humanoid_course.report import quoted

ROBOTS = ('robot1', 'robot2', 'robot3')
NAME = 'joint_commands'
KIND = 'sensor_msgs/msg/JointState'
TOPICS = tuple(f'/{robot}/{NAME}' for robot in ROBOTS)


def check_launch(submission: Submission) -> Verdict:
    """
    Check that a launch file starts three controllers.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    run = submission.launch(_is_complete)
    if not run.command:
        return common.missing_launch_file(submission, f'{len(ROBOTS)} joint controllers')
    expected = f'{len(ROBOTS)} controllers'
    if not run.ran:
        return failed(
            f'{run.command} ended by itself; {common.last_line(run.output)}',
            expected,
            'Run that command, and correct the error that it reports.',
        )
    controllers = _controllers(run)
    if len(controllers) < len(ROBOTS):
        return failed(
            f'{run.command} starts {len(controllers)} nodes that publish {NAME}: '
            f'{quoted(controllers)}; all nodes: {quoted(run.nodes)}',
            expected,
            'Add a Node(...) for each robot, with executable="joint_controller" and '
            'namespace="robot1", "robot2", "robot3". If this is not the launch file of the '
            'exercise, name it with --launch-file.',
        )
    return passed(f'{run.command}: {quoted(controllers)}')


def check_topics(submission: Submission) -> Verdict:
    """
    Check that each controller has a topic of its own.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    run = submission.launch(_is_complete)
    found = [name for name in run.publishers if name.endswith(NAME)]
    missing = [name for name in TOPICS if name not in found]
    expected = quoted(TOPICS)
    if f'/{NAME}' in found and missing:
        return failed(
            f"the controllers publish on '/{NAME}', which a namespace does not change",
            expected,
            f"Write '{NAME}' without the slash at the beginning in create_publisher(), or add "
            f"remappings=[('/{NAME}', '{NAME}')] to each Node(...) of the launch file.",
        )
    if missing:
        return failed(
            f'topics: {quoted(found)}',
            expected,
            "Give each Node(...) its namespace: namespace='robot1', 'robot2', 'robot3'.",
        )
    wrong = [name for name in TOPICS if run.publishers[name][0].kind != KIND]
    if wrong:
        return failed(
            f'{wrong[0]} has the type {run.publishers[wrong[0]][0].kind}',
            KIND,
            f'Publish {KIND} in the controller.',
        )
    return passed(expected)


def check_independence(submission: Submission) -> Verdict:
    """
    Check that each topic carries messages, which a node of its own publishes.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    run = submission.launch(_is_complete)
    silent = [name for name in TOPICS if run.counts.get(name, 0) < FIRST_MESSAGES]
    if silent:
        return failed(
            f'{run.counts.get(silent[0], 0)} messages on {silent[0]} in the time of the check',
            f'at least {FIRST_MESSAGES} on each topic',
            'Publish from a timer in the controller, and spin the node.',
        )
    owners = {name: {each.node for each in run.publishers[name]} for name in TOPICS}
    shared = [name for name in TOPICS if len(owners[name]) != 1]
    if shared or len(set().union(*owners.values())) < len(TOPICS):
        name = (shared or TOPICS)[0]
        return failed(
            f'{name} is published by {quoted(sorted(owners[name]))}',
            'a node of its own for each topic',
            'Start one controller in each namespace, and remap no topic to that of another robot.',
        )
    return passed(', '.join(f'{name}: {run.counts[name]} messages' for name in TOPICS))


def check_launch_end(submission: Submission) -> Verdict:
    """
    Check that Ctrl-C ends the launch with everything that it started.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    return common.check_end(submission.launch(_is_complete), 'the launch with all its nodes')


def _controllers(run: Run) -> list[str]:
    """Return the nodes that publish joint commands, each as often as it is there."""
    return sorted(
        endpoint.node
        for topic, endpoints in run.publishers.items()
        if topic.endswith(NAME)
        for endpoint in endpoints
    )


def _is_complete(run: Run) -> bool:
    return all(run.counts.get(name, 0) >= FIRST_MESSAGES for name in TOPICS)


EXERCISE = Exercise[Submission](
    'exercise_2',
    'launch three controllers, each in a namespace of its own',
    ('humanoid_control',),
    (
        common.MANIFESTS,
        common.DEPENDENCIES,
        common.BUILD,
        Check('launch', 'a launch file starts three controllers', check_launch, ('build',)),
        Check(
            'topics', f'the topics are {TOPICS[0]}, robot2 and robot3', check_topics, ('launch',)
        ),
        Check(
            'independence',
            'each topic is published by a node of its own',
            check_independence,
            ('topics',),
        ),
        Check(
            'launch_end',
            'one Ctrl-C ends the launch and all controllers',
            check_launch_end,
            ('launch',),
        ),
    ),
    launch_words=('robot3', 'robot2', 'namespace'),
)
