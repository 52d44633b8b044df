# SPDX-License-Identifier: Apache-2.0
"""Exercise 1: one node publishes temperatures, another one logs those that are high."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
import re

from humanoid_common.naming import did_you_mean
from humanoid_course import common_checks as common
from humanoid_course.common_checks import Check
from humanoid_course.grading import Exercise, failed, Outcome, passed, unchecked, Verdict
from humanoid_course.observations import Endpoint, FIRST_MESSAGES, line_pattern, Run, Submission
from humanoid_course.report import quoted

TOPIC = '/temperature'
PUBLISHER, ANALYZER = 'temp_publisher', 'temp_analyzer'
LOWEST, HIGHEST, THRESHOLD = 20.0, 30.0, 25.0


def check_publisher(submission: Submission) -> Verdict:
    """
    Check that the publisher starts and keeps running.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    run = _publisher(submission)
    ended = common.check_ran(run, PUBLISHER)
    if ended is not None:
        return ended
    if not run.nodes:
        return failed(
            f'{PUBLISHER} runs, but no ROS node appeared',
            'a node',
            'Call rclpy.init() and create the node in main().',
        )
    return passed(f'node {quoted(run.nodes)}')


def check_data(submission: Submission) -> Verdict:
    """
    Check that readings arrive on the topic.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    run = _publisher(submission)
    found = run.publishers.get(TOPIC, ())
    if not found:
        names = [name for name in run.publishers if name != TOPIC]
        hint = did_you_mean(TOPIC, names)
        return failed(
            f'nothing is published on {TOPIC}; topics: {quoted(names)}',
            f'a publisher on {TOPIC}',
            f"{hint} Name the topic 'temperature' in create_publisher().".strip(),
        )
    kind, values = found[0].kind, run.values.get(TOPIC, ())
    if not run.counts.get(TOPIC):
        return failed(
            f'{TOPIC} ({kind}) carries no messages',
            'readings on it, at least one every few seconds',
            'Publish from a timer: self.create_timer(1.0, self.callback), and spin the node.',
        )
    if not values or isinstance(values[0], str):
        return failed(
            f'{TOPIC} has the type {kind}',
            'a type with the temperature as a number',
            'Use sensor_msgs/msg/Temperature, or std_msgs/msg/Float32.',
        )
    return passed(f'{kind}, for example {values[0]:g}')


def check_range(submission: Submission) -> Verdict:
    """
    Check that the readings are random and in the range.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    values = [float(each) for each in _publisher(submission).values.get(TOPIC, ())]
    if len(values) < FIRST_MESSAGES:
        return unchecked(
            f'only {len(values)} readings came in the time of the check',
            'Publish once a second or faster, then check again.',
        )
    outside = [each for each in values if not LOWEST <= each <= HIGHEST]
    expected = f'random readings from {LOWEST:g} to {HIGHEST:g}'
    if outside:
        return failed(
            f'{len(outside)} of {len(values)} readings are outside, such as {outside[0]:g}',
            expected,
            f'Draw each reading with random.uniform({LOWEST}, {HIGHEST}).',
        )
    if len(set(values)) == 1:
        return failed(
            f'all {len(values)} readings are {values[0]:g}',
            expected,
            'Draw a new number in each call of the timer, not once at the start.',
        )
    return passed(f'{len(values)} readings from {min(values):.1f} to {max(values):.1f}')


def check_analyzer(submission: Submission) -> Verdict:
    """
    Check that the analyzer runs and subscribes to what the publisher publishes.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    run = _listener_run(submission)
    ended = common.check_ran(run, ANALYZER)
    if ended is not None:
        return ended
    found = run.subscriptions.get(TOPIC, ())
    if not found:
        hint = did_you_mean(TOPIC, run.subscriptions)
        return failed(
            f'{ANALYZER} subscribes to: {quoted(list(run.subscriptions))}',
            f'a subscription to {TOPIC}',
            f"{hint} Name the topic 'temperature' in create_subscription().".strip(),
        )
    published = _publisher(submission).publishers.get(TOPIC, ())
    if published and published[0].kind != found[0].kind:
        return failed(
            f'{ANALYZER} subscribes with {found[0].kind}, {PUBLISHER} publishes '
            f'{published[0].kind}',
            'the same type in both nodes',
            'Import the same message in both modules.',
        )
    return passed(f'{TOPIC}, {found[0].kind}')


def check_alarm(submission: Submission) -> Verdict:
    """
    Check that the analyzer logs readings above the threshold, and tells them from others.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    seen = submission.run_listener(ANALYZER, TOPIC)
    if not seen.kind:
        return unchecked(
            f'the type of {TOPIC} has no number to send', 'Use sensor_msgs/msg/Temperature.'
        )
    cold, hot = (
        {line_pattern(line) for line in lines}
        for lines in (seen.lines_when_cold, seen.lines_when_hot)
    )
    new = [line for line in seen.lines_when_hot if line_pattern(line) not in cold]
    logged = [line for line in new if _is_log(line)]
    expected = f'a log message for readings above {THRESHOLD:g} °C only'
    if logged:
        return passed(f'{seen.cold:g}: no warning; {seen.hot:g}: {logged[0].strip()}')
    if new:
        return failed(
            f'at {seen.hot:g} it prints instead of logging: {new[0].strip()}',
            expected,
            'Use self.get_logger().warning(...), whose lines carry the name of the node.',
        )
    if hot:
        return failed(
            f'it writes the same at {seen.cold:g} and at {seen.hot:g}: '
            f'{seen.lines_when_hot[0].strip()}',
            expected,
            f'Compare the reading with {THRESHOLD:g} before you log it as high.',
        )
    return failed(
        f'it was sent {seen.hot:g} several times, and logged nothing',
        expected,
        f'Log in the callback: if reading > {THRESHOLD}: self.get_logger().warning(...).',
    )


def check_interrupt(submission: Submission) -> Verdict:
    """
    Check that Ctrl-C ends each of both nodes.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    runs = [(_publisher(submission), PUBLISHER), (_listener_run(submission), ANALYZER)]
    for run, executable in runs:
        verdict = common.check_interrupt(run, executable)
        if verdict.outcome is not Outcome.PASSED:
            return verdict
    return passed(f'{PUBLISHER} and {ANALYZER} ended')


def check_launch(submission: Submission) -> Verdict:
    """
    Check that a launch file starts a node that publishes and one that subscribes.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    run = submission.launch(_both_run)
    if not run.command:
        return common.missing_launch_file(submission, f'{PUBLISHER} and {ANALYZER}')
    expected = f'a node that publishes {TOPIC} and another one that subscribes to it'
    advice = f'Add a Node(package=..., executable=...) for each of {PUBLISHER} and {ANALYZER}.'
    if not run.ran:
        return failed(
            f'{run.command} ended by itself; {common.last_line(run.output)}',
            expected,
            'Run that command, and correct the error that it reports.',
        )
    if _both_run(run):
        return passed(run.command)
    publishers, subscribers = _names(run.publishers), _names(run.subscriptions)
    return failed(
        f'{run.command} starts: {quoted(run.nodes)}; {TOPIC} is published by '
        f'{quoted(publishers)} and received by {quoted(subscribers)}',
        expected,
        advice,
    )


def check_launch_end(submission: Submission) -> Verdict:
    """
    Check that Ctrl-C ends the launch with everything that it started.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    return common.check_end(submission.launch(_both_run), 'the launch with all its nodes')


def _publisher(submission: Submission) -> Run:
    return submission.run_publisher(PUBLISHER, TOPIC)


def _listener_run(submission: Submission) -> Run:
    return submission.run_listener(ANALYZER, TOPIC).run


def _names(endpoints: Mapping[str, tuple[Endpoint, ...]]) -> list[str]:
    """Return the nodes at the topic."""
    return sorted({each.node for each in endpoints.get(TOPIC, ())})


def _both_run(run: Run) -> bool:
    """Whether the topic is published and received, by different nodes."""
    publishers, subscribers = _names(run.publishers), _names(run.subscriptions)
    return bool(publishers and subscribers) and len({*publishers, *subscribers}) > 1


def _is_log(line: str) -> bool:
    return bool(re.match(r'\[(DEBUG|INFO|WARN|ERROR|FATAL)\]', line))


EXERCISE = Exercise[Submission](
    'exercise_1',
    'create a package that monitors a temperature',
    ('temperature_monitor',),
    (
        common.MANIFESTS,
        common.DEPENDENCIES,
        common.BUILD,
        Check(
            'executables',
            f'ros2 run finds {PUBLISHER} and {ANALYZER}',
            partial(common.check_executables, wanted=(PUBLISHER, ANALYZER)),
            ('build',),
        ),
        Check('publisher', f'{PUBLISHER} runs', check_publisher, ('executables',)),
        Check('data', f'{TOPIC} carries numbers', check_data, ('publisher',)),
        Check(
            'range',
            f'the readings are random, from {LOWEST:g} to {HIGHEST:g} °C',
            check_range,
            ('data',),
        ),
        Check(
            'analyzer', f'{ANALYZER} runs and subscribes to {TOPIC}', check_analyzer,
            ('executables',),
        ),
        Check(
            'alarm',
            f'{ANALYZER} logs readings above {THRESHOLD:g} °C, and only those',
            check_alarm,
            ('analyzer',),
        ),
        Check(
            'interrupt',
            'Ctrl-C ends each node, without a traceback',
            check_interrupt,
            ('publisher', 'analyzer'),
        ),
        Check(
            'launch', 'a launch file starts both nodes', check_launch, ('data', 'analyzer')
        ),
        Check(
            'launch_end',
            'one Ctrl-C ends the launch and both nodes',
            check_launch_end,
            ('launch', 'interrupt'),
        ),
    ),
    launch_words=(PUBLISHER, ANALYZER),
)  # fmt: skip
