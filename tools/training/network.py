# SPDX-License-Identifier: Apache-2.0
"""
The detector: a small convolutional network without anchors.

It is written once, in terms of a few operations; `jax_operations` trains it and `onnx_graph`
writes it to a file, so that both are the same network.

The backbone is a residual network of 3x3 convolutions (He et al., 2016) of strides 4, 8, 16 and
32; a feature pyramid (Lin et al., 2017) leads what the deep layers know back to fine ones. There
is a head at the strides 4, 8 and 16, as a mug at 3 m is seven pixels high. For each cell, a head
predicts one box and a score for each class, as FCOS does (Tian et al., 2019).
"""

from __future__ import annotations

from typing import Any, Protocol

from pictures import CLASSES

STRIDES = (4, 8, 16)
HEIGHT_PX, WIDTH_PX = 256, 320
"""The size of the input; a picture of 320x240 gets a border above and below."""
SIZE_OF_STRIDE = 2.0
"""The box that a cell predicts if its outputs are 0 is so many strides wide and high."""
OUTPUTS = 4 + len(CLASSES)
LARGEST_EXPONENT = 4.0


class Operations(Protocol):
    """What the network is made of; tensors are whatever an implementation uses."""

    def conv(self, name: str, x: Any, channels: int, size: int = 3, stride: int = 1) -> Any:
        """
        Convolve, normalise and rectify.

        Parameters
        ----------
        name
            The name of the layer, which its weights have.
        x
            The input.
        channels
            How many channels the output has.
        size
            The edge of the kernel in pixels.
        stride
            The output is so many times as small as the input, across and down.

        """

    def linear(self, name: str, x: Any, channels: int) -> Any:
        """
        Convolve 1x1 with a bias.

        Parameters
        ----------
        name
            The name of the layer, which its weights have.
        x
            The input.
        channels
            How many channels the output has.

        """

    def add(self, name: str, a: Any, b: Any) -> Any:
        """
        Add two tensors of one shape.

        Parameters
        ----------
        name
            The name of the layer.
        a, b
            The tensors.

        """

    def double(self, name: str, x: Any) -> Any:
        """
        Double width and height, by repeating values.

        Parameters
        ----------
        name
            The name of the layer.
        x
            The input.

        """


def network(ops: Operations, x: Any) -> list[Any]:
    """
    Build the network, or run it, from a set of operations.

    Parameters
    ----------
    ops
        The operations.
    x
        The input in terms of these operations: pictures of 3 channels, 0 to 1.

    Returns
    -------
    list
        For each stride the outputs of all cells: x, y, log width, log height, and the logit of the
        score of each class.

    """
    s4 = _stage(ops, 's4', ops.conv('stem', x, 16, 3, 2), 32, 1)
    s8 = _stage(ops, 's8', s4, 64, 1)
    s16 = _stage(ops, 's16', s8, 80, 2)
    s32 = _stage(ops, 's32', s16, 96, 1)
    p16 = _merged(ops, 'p16', s16, s32, 48)
    p16 = ops.conv('p16_out', p16, 48)
    p8 = ops.conv('p8_out', _merged(ops, 'p8', s8, p16, 48), 48)
    p4 = _merged(ops, 'p4', s4, p8, 32)
    hidden = [(p4, 48), (p8, 48), (p16, 48)]
    return [
        ops.linear(f'h{stride}_out', ops.conv(f'h{stride}', level, channels), OUTPUTS)
        for stride, (level, channels) in zip(STRIDES, hidden)
    ]


def _stage(ops: Operations, name: str, x: Any, channels: int, blocks: int) -> Any:
    """Halve width and height, then add residual blocks with half the channels inside."""
    x = ops.conv(f'{name}_in', x, channels, 3, 2)
    for number in range(blocks):
        inside = ops.conv(f'{name}_{number}a', x, channels // 2)
        inside = ops.conv(f'{name}_{number}b', inside, channels)
        x = ops.add(f'{name}_{number}', x, inside)
    return x


def _merged(ops: Operations, name: str, fine: Any, coarse: Any, channels: int) -> Any:
    """Add features of a stride and those of the next one, in so many channels."""
    above = ops.double(f'{name}_above', ops.conv(f'{name}_down', coarse, channels, 1))
    return ops.add(f'{name}_sum', ops.conv(f'{name}_side', fine, channels, 1), above)
