# SPDX-License-Identifier: Apache-2.0
"""The base class of panels with a web page that is told what is new."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from robot_console.namespaces import NAMESPACE, topic_of_robot
from robot_console.small_page import SmallPage
from rviz_common.pace import Pace
from rviz_common.page.channel import Action, Channel, Viewer
from rviz_common.panel import Panel
from rviz_common.properties import Property

__all__ = ['LivePanel']


class LivePanel(Panel):
    """
    A panel with a web page; `refresh` is called periodically, `begin` and `end` once.

    While no page is open, the only cost is that of the subscriptions made in `begin`.
    """

    PAGE: ClassVar[str]
    """The name of the page and of its file."""
    PACKAGE: ClassVar[str] = 'robot_console'
    """The package that contains the file, in its folder `web`."""
    ORDER: ClassVar[float | None] = None
    """The order of the page among the widgets; None to append it."""
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
            self.ORDER,
            package=self.PACKAGE,
        )
        try:
            self.begin()
        except Exception:
            self._page.close()
            raise

    def update(self) -> None:
        """Send updates, a few times a second."""
        if self._pace.is_due():
            self.refresh()

    def close(self) -> None:
        """Remove the page, and release the resources of the panel."""
        self._page.close()
        self.end()

    def settings(self) -> dict[str, Any]:
        """Return the initial settings of the page."""
        return {}

    def actions(self) -> Mapping[str, Action]:
        """Return the actions that the page may request."""
        return {}

    def begin(self) -> None:
        """Start work that continues without viewers; called before the first one connects."""

    def greet(self, viewer: Viewer) -> None:
        """
        Send the current state to a viewer that has just connected.

        Parameters
        ----------
        viewer
            The viewer.

        """

    def refresh(self) -> None:
        """Send updates to the viewers."""

    def end(self) -> None:
        """Stop the work that was started in `begin`."""

    def full_name(self, topic: str) -> str:
        """
        Resolve the topic name of a robot to a fully qualified name.

        Parameters
        ----------
        topic
            The name; a relative name is placed in the namespace of the panel.

        Raises
        ------
        ValueError
            The name is not a valid topic name; the message is a full sentence.

        """
        return topic_of_robot(self.context.node, self.values['Namespace'], topic)
