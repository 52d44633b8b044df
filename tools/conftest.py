# SPDX-License-Identifier: Apache-2.0
"""
What all tests of tools/ need, in one process or, as `make test` runs them, in several.

A process has a DDS domain, a log folder and a working Ctrl-C of its own. With several, the tests
of a file stay together.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator
import gc
from pathlib import Path
import signal
import sys
from typing import Any

from domain_coordinator import domain_id
import pytest

SHARE_NOTHING = ('test_docs.py',)

# A shell that starts the tests in the background lets them, and all that they start, ignore it.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope='session', autouse=True)
def _of_its_own(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Keep what this process starts apart from what others do: its nodes and its logs."""
    with domain_id() as domain, pytest.MonkeyPatch.context() as patch:
        patch.setenv('ROS_DOMAIN_ID', str(domain))
        patch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
        patch.delenv('ROS_DISCOVERY_SERVER', raising=False)
        patch.setenv('ROS_LOG_DIR', str(tmp_path_factory.mktemp('log')))
        yield


def pytest_collection_finish() -> None:
    """
    Take what there is now, of thousands of tests, out of the collection of garbage.

    It stays until the end. Tests of nodes collect garbage when they end, to close the sockets
    that rclpy leaves, and would go through all of it each time.
    """
    gc.collect()
    gc.freeze()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport() -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Add to the report of a test that failed what the pages of its browser say."""
    report = yield
    browser = sys.modules.get('browser')
    if report.failed and browser is not None:
        report.sections += browser.texts_of_pages()
    return report


def pytest_make_parametrize_id(val: object, argname: str) -> str | None:
    """Keep what is long out of the names of tests, which processes tell each other."""
    return f'{argname}_of_{len(val)}' if isinstance(val, (str, bytes)) and len(val) > 200 else None


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """With `--dist loadfile`, hand out tests by what they have in common."""
    if config.getvalue('dist') != 'loadfile':
        return None
    from xdist.scheduler import LoadFileScheduling

    class Shared(LoadFileScheduling):
        def _split_scope(self, nodeid: str) -> str:
            return shared(nodeid)

        def remove_node(self, node: Any) -> str | None:
            """Return the test in which a process died, if any, which does not run again."""
            work = self.assigned_work.pop(node)
            left = [(unit, test) for unit in work.values() for test in unit if not unit[test]]
            if not left:
                return None
            unit, died = left[0]
            unit[died] = True
            self.workqueue.update(
                {at: unit for at, unit in work.items() if not all(unit.values())}
            )
            for other in self.nodes:
                self._reschedule(other)
            return str(died)

        def _reschedule(self, node: Any) -> None:
            """Give a process more to do, unless it is not ready, or has just died."""
            if node not in self.registered_collections:
                return
            waiting = set(self.workqueue)
            try:
                super()._reschedule(node)
            except OSError:  # nobody has heard yet that it died
                for scope in waiting.difference(self.workqueue):
                    self.workqueue[scope] = self.assigned_work[node].pop(scope)

    return Shared(config, log)


def shared(nodeid: str) -> str:
    """Return what a test shares with those that stay in its process: for most it is their file."""
    file = nodeid.partition('::')[0]
    name = Path(file).name
    if 'browser' in name:
        return 'browser'  # drawing without a graphics card takes all processors: one at a time
    return nodeid if name in SHARE_NOTHING else file
