# SPDX-License-Identifier: Apache-2.0
"""A panel that is a small page, which is told what is new."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from robot_console.live.channel import Action, Channel
from robot_console.live.viewer import Viewer
from robot_console.namespaces import NAMESPACE, topic_of_robot
from robot_console.small_page import SmallPage
from rviz_common.pace import Pace
from rviz_common.panel import Panel
from rviz_common.properties import Property

__all__ = ['LivePanel']


class LivePanel(Panel):
    """
    A panel that is a small page; `refresh` is called now and then, `begin` and `end` once.

    As long as nobody looks at the page, it costs nothing but what `begin` has begun.
    """

    PAGE: ClassVar[str]
    """The name of the page, and of its file."""
    PACKAGE: ClassVar[str] = 'robot_console'
    """The package that has the file, in its folder `web`."""
    PERIOD_S: ClassVar[float] = 0.2
    PROPERTIES: ClassVar[tuple[Property, ...]] = (NAMESPACE,)

    def start(self) -> None:
        """Add the page."""
        self._pace = Pace(self.PERIOD_S)
        self.channel = Channel(self.context.queue, self.greet, self.actions())
        namespace = self.values['Namespace']
        self._page = SmallPage(
            self.context,
            self.PAGE,
            namespace,
            self.settings(),
            self.channel,
            package=self.PACKAGE,
        )
        try:
            self.begin()
        except Exception:
            self._page.close()
            raise

    def update(self) -> None:
        """Tell what is new, a few times a second."""
        if self._pace.is_due():
            self.refresh()

    def close(self) -> None:
        """Remove the page, and end what it needed."""
        self._page.close()
        self.end()

    def settings(self) -> dict[str, Any]:
        """Return what the page is to know from the beginning."""
        return {}

    def actions(self) -> Mapping[str, Action]:
        """Return what the page may ask for."""
        return {}

    def begin(self) -> None:
        """Begin what is done also while nobody looks; nobody comes before."""

    def greet(self, viewer: Viewer) -> None:
        """
        Send the current state to a viewer that has just connected.

        Parameters
        ----------
        viewer
            The viewer.

        """

    def refresh(self) -> None:
        """Tell what is new."""

    def end(self) -> None:
        """End what has been begun."""

    def full_name(self, topic: str) -> str:
        """
        Resolve the topic name of a robot to a fully qualified one.

        Parameters
        ----------
        topic
            The name; a relative one is put into the namespace of the panel.

        Raises
        ------
        ValueError
            It is no valid topic name; the text is a sentence.

        """
        return topic_of_robot(self.context.node, self.values['Namespace'], topic)
