# SPDX-License-Identifier: Apache-2.0
"""The node that receives images over one transport and publishes them over others."""

from __future__ import annotations

from typing import TYPE_CHECKING

from image_transport.publishing import ImagePublisher
from image_transport.transports import check_transport, subscribe_to_images, topic_of
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.node import Node
from rclpy.parameter import Parameter
from robot_state_publisher.node_arguments import unknown_overrides

if TYPE_CHECKING:
    from rclpy.subscription import Subscription

__all__ = ['Republisher']


class Republisher(Node):
    """
    Receives images on `in` and publishes them on `out`, each over transports of its own.

    It subscribes only while somebody listens.

    Parameters
    ----------
    *transports
        Values of the parameters `in_transport` and `out_transport`, which go before others.

    Raises
    ------
    ValueError
        There is no such transport, or the node would receive what it publishes.

    """

    def __init__(self, *transports: str) -> None:
        names = ('in_transport', 'out_transport')
        given = [Parameter(name, value=text) for name, text in zip(names, transports)]
        super().__init__('image_republisher', parameter_overrides=given)
        self._transport = check_transport(
            self._declared('in_transport', 'raw', 'Transport of the images on in.')
        )
        out = self._declared(
            'out_transport', '', 'Transport of the images on out; all if it is empty.'
        )
        self._subscription: Subscription | None = None
        self._publisher = ImagePublisher(
            self, 'out', [out] if out else None, on_match=self._follow_demand
        )
        source = topic_of(self, 'in', self._transport)
        if source in self._publisher.topics():
            raise ValueError(
                f'republish would receive what it publishes on {source}. Remap out to another '
                'topic, or name an out_transport other than that of the input.'
            )
        for sentence in unknown_overrides(self):
            self.get_logger().warning(sentence)
        self.get_logger().info(
            f'Republishing {source} on {", ".join(self._publisher.topics())} while there '
            'are subscribers.'
        )

    def _declared(self, name: str, default: str, description: str) -> str:
        descriptor = ParameterDescriptor(description=description, read_only=True)
        return str(self.declare_parameter(name, default, descriptor).value)

    def _follow_demand(self) -> None:
        """Subscribe when the first listener has come, and unsubscribe when the last has gone."""
        is_wanted = self._publisher.subscription_count() > 0
        if is_wanted and self._subscription is None:
            self._subscription = subscribe_to_images(
                self, 'in', self._publisher.publish, self._transport
            )
        elif not is_wanted and self._subscription is not None:
            self.destroy_subscription(self._subscription)
            self._subscription = None
