# SPDX-License-Identifier: Apache-2.0
"""A node that publishes texts only while it is active."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from rclpy.lifecycle import LifecycleState, Node, TransitionCallbackReturn
from std_msgs.msg import String
from tf2_ros.program import run_node

__all__ = ['LifecycleTalker', 'main']

PERIOD_S = 1.0


class LifecycleTalker(Node):
    """
    Publishes a text each second on `lifecycle_chatter`, from configured on, if active.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.lifecycle.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('lc_talker', **options)
        self._publisher: Any = None
        self._timer: Any = None
        self._count = 0
        self.get_logger().info('Unconfigured. It publishes once it is configured and activated.')

    def publish(self) -> None:
        """Publish the next text, or log that the publisher is inactive."""
        self._count += 1
        message = String(data=f'Lifecycle HelloWorld #{self._count}')
        if self._publisher.is_activated:
            self.get_logger().info(f'Lifecycle publisher is active. Publishing: [{message.data}]')
        else:
            self.get_logger().info(
                'Lifecycle publisher is currently inactive. Messages are not published.'
            )
        self._publisher.publish(message)

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        Create the publisher and its timer.

        Parameters
        ----------
        state
            The state before.

        """
        self._publisher = self.create_lifecycle_publisher(String, 'lifecycle_chatter', 10)
        self._timer = self.create_timer(PERIOD_S, self.publish)
        return self._told('on_configure')

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        Activate the publisher.

        Parameters
        ----------
        state
            The state before.

        """
        result = super().on_activate(state)
        self._told('on_activate')
        return result

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        Deactivate the publisher.

        Parameters
        ----------
        state
            The state before.

        """
        result = super().on_deactivate(state)
        self._told('on_deactivate')
        return result

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        Destroy the publisher and its timer.

        Parameters
        ----------
        state
            The state before.

        """
        self._release()
        return self._told('on_cleanup')

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        Destroy the publisher and its timer.

        Parameters
        ----------
        state
            The state before.

        """
        self._release()
        self.get_logger().info(f'on_shutdown() is called from state {state.label}.')
        return TransitionCallbackReturn.SUCCESS

    def _release(self) -> None:
        if self._timer is not None:
            self.destroy_timer(self._timer)
            self.destroy_publisher(self._publisher)
            self._timer = self._publisher = None

    def _told(self, name: str) -> TransitionCallbackReturn:
        self.get_logger().info(f'{name}() is called.')
        return TransitionCallbackReturn.SUCCESS


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: LifecycleTalker(), args)


if __name__ == '__main__':
    sys.exit(main())
