# SPDX-License-Identifier: Apache-2.0
"""Check that all frames are connected."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator

from ros2doctor.api.extension import Finding, Report, Severity
from ros2doctor.check.graph import Graph, GraphCheck, GraphReport
from ros2doctor.check.listening import STATIC_SUFFIX, Transform, TRANSFORM_TYPE

FRAMES_OF_WORLD = ('earth', 'world', 'map', 'odom')  # the order of REP-105

AFTER_CLOCK = (
    'start a publisher of /clock first: without it, nodes publish no transforms of moving parts; '
    'then check again'
)
Parents = dict[str, set[str]]


class FramesCheck(GraphCheck):
    """Check of the transform trees."""

    def category(self) -> str:
        """Return the category."""
        return 'frames'

    def findings(self, graph: Graph) -> Iterator[Finding]:
        """
        Check for problems that make transform lookups fail.

        Parameters
        ----------
        graph
            As for `GraphCheck.findings`; its `transforms` and `without_clock` are examined.

        Yields
        ------
        Finding
            As for `frame_findings`.

        """
        yield from frame_findings(graph.transforms, bool(graph.without_clock))


def frame_findings(
    transforms: Iterable[Transform], waits_for_clock: bool = False
) -> Iterator[Finding]:
    """
    Report problems of the frame trees formed by transforms.

    Parameters
    ----------
    transforms
        The edges of all trees; those of different topics form different trees.
    waits_for_clock
        Whether nodes wait for a /clock, and therefore may not publish their transforms.

    Yields
    ------
    Finding
        An error for a frame with several parents, or for frames without a root; a warning if the
        frames of one topic have several roots.

    """
    trees: dict[str, Parents] = defaultdict(lambda: defaultdict(set))
    for transform in transforms:
        trees[transform.tree][transform.child].add(transform.parent)
    for topic, parents in sorted(trees.items()):
        doubtful = list(_two_parents(topic, parents))
        yield from doubtful
        found = roots(parents)
        if len(found) > 1 and not doubtful:
            mend = AFTER_CLOCK if waits_for_clock else _joining(topic, found)
            yield _two_roots(topic, found, mend)
        circling = set(parents) - _below(found, parents)
        if circling and not doubtful:
            yield _loop(topic, circling)


def roots(parents: Parents) -> list[str]:
    """
    List the root frames: those with children but without a parent.

    Parameters
    ----------
    parents
        The parents of each frame that has any, by child.

    Returns
    -------
    list of str
        World frames first, in the order of REP 105, then the others by name.

    """
    above = {parent for each in parents.values() for parent in each}
    return sorted(above - set(parents), key=_rank)


def _rank(frame: str) -> tuple[int, str]:
    return FRAMES_OF_WORLD.index(frame) if frame in FRAMES_OF_WORLD else len(
        FRAMES_OF_WORLD
    ), frame


def _two_parents(topic: str, parents: Parents) -> Iterator[Finding]:
    for child, above in sorted(parents.items()):
        if len(above) > 1:
            yield Finding(
                Severity.ERROR,
                f"on '{topic}', the frame '{child}' has {len(above)} parents: "
                f'{", ".join(sorted(above))}',
                'it jumps between them, because each new transform replaces the other',
                'stop one of the nodes that publish it; to see which there are: '
                f'ros2 topic info --verbose {topic}',
            )


def _two_roots(topic: str, found: list[str], mend: str) -> Finding:
    return Finding(
        Severity.WARNING,
        f"on '{topic}' there are {len(found)} frame trees, with the roots {', '.join(found)}",
        'there is no transform between frames of different trees',
        mend,
    )


def _joining(topic: str, found: list[str]) -> str:
    """Format the fix that joins the first two trees."""
    return (
        'start the node that publishes what is missing, or publish it by hand until Ctrl-C (here '
        f"'{found[1]}' at the origin of '{found[0]}'; change that):\n"
        f'{_publish_command(topic, found[0], found[1])}'
    )


def _publish_command(topic: str, parent: str, child: str) -> str:
    transform = (
        f'{{header: {{frame_id: {parent}}}, child_frame_id: {child}, '
        'transform: {translation: {x: 0.0}, rotation: {w: 1.0}}}'
    )
    return (
        f'ros2 topic pub -r 1 --qos-durability transient_local {topic}{STATIC_SUFFIX} '
        f"{TRANSFORM_TYPE} '{{transforms: [{transform}]}}'"
    )


def _below(found: list[str], parents: Parents) -> set[str]:
    """Return the frames that descend from the roots."""
    below: set[str] = set()
    more = set(found)
    while more:
        below |= more
        more = {child for child, above in parents.items() if above & below} - below
    return below


def _loop(topic: str, frames: set[str]) -> Finding:
    return Finding(
        Severity.ERROR,
        f"on '{topic}', the frames form a loop: {', '.join(sorted(frames))}",
        'no transform between them can be looked up',
        f'stop one of the nodes that publish them: ros2 topic info --verbose {topic}',
    )


class FramesReport(GraphReport):
    """Report of the transforms."""

    TITLE = 'TRANSFORMS'

    def category(self) -> str:
        """Return the category."""
        return 'frames'

    def fill(self, report: Report, graph: Graph) -> None:
        """
        Add each transform as `parent -> child`, with its topic.

        Parameters
        ----------
        report, graph
            As for `GraphReport.fill`.

        """
        for tree, parent, child in sorted(graph.transforms):
            report.add_to_report(tree, f'{parent} -> {child}')
