# SPDX-License-Identifier: Apache-2.0
"""The operations of the network in JAX; layout NHWC, which is the fast one of its CPU backend."""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
from network import network
import numpy as np

Weights = dict[str, Any]
"""By name: `NAME/weight` (height, width, in, out), and `NAME/scale` and `NAME/shift` of its batch
normalisation (Ioffe and Szegedy, 2015), or `NAME/bias`."""
Statistics = dict[str, Any]
"""By name: `NAME/mean` and `NAME/variance` of what comes out of a convolution."""

EPSILON = 1e-3
_PRIOR = 0.01
"""The score that all cells begin with."""


class _Initial:
    """Makes weights while the network is built with the number of channels for a tensor."""

    def __init__(self, seed: int) -> None:
        self._random = np.random.default_rng(seed)
        self.weights: dict[str, np.ndarray[Any, Any]] = {}
        self.statistics: dict[str, np.ndarray[Any, Any]] = {}

    def conv(self, name: str, x: int, channels: int, size: int = 3, stride: int = 1) -> int:
        fan_in = size * size * x
        weight = self._random.normal(0.0, np.sqrt(2.0 / fan_in), (size, size, x, channels))
        # A residual block begins as the identity.
        scale = 0.3 if name.endswith('b') else 1.0
        self.weights[f'{name}/weight'] = weight.astype(np.float32)
        self.weights[f'{name}/scale'] = np.full(channels, scale, np.float32)
        self.weights[f'{name}/shift'] = np.zeros(channels, np.float32)
        self.statistics[f'{name}/mean'] = np.zeros(channels, np.float32)
        self.statistics[f'{name}/variance'] = np.ones(channels, np.float32)
        return channels

    def linear(self, name: str, x: int, channels: int) -> int:
        weight = self._random.normal(0.0, 0.01, (1, 1, x, channels))
        bias = np.zeros(channels, np.float32)
        bias[4:] = -np.log(1.0 / _PRIOR - 1.0)
        self.weights[f'{name}/weight'] = weight.astype(np.float32)
        self.weights[f'{name}/bias'] = bias
        return channels

    def add(self, name: str, a: int, b: int) -> int:
        if a != b:
            raise ValueError(f'{name}: tensors of {a} and {b} channels cannot be added.')
        return a

    def double(self, name: str, x: int) -> int:
        return x


def initial_weights(seed: int) -> tuple[Weights, Statistics]:
    """
    Draw random weights (He et al., 2015), and return them with initial statistics.

    Parameters
    ----------
    seed
        Of the random numbers.

    """
    ops = _Initial(seed)
    network(ops, 3)
    return ops.weights, ops.statistics


class _Jax:
    """Runs the network on a batch."""

    def __init__(self, weights: Weights, statistics: Statistics, is_training: bool) -> None:
        self._weights, self._statistics = weights, statistics
        self._is_training = is_training
        self.seen: Statistics = {}

    def conv(self, name: str, x: Any, channels: int, size: int = 3, stride: int = 1) -> Any:
        y = _convolved(x, self._weights[f'{name}/weight'], stride)
        if self._is_training:
            mean = y.mean((0, 1, 2))
            variance = jnp.maximum((y * y).mean((0, 1, 2)) - mean * mean, 0.0)
            self.seen[f'{name}/mean'], self.seen[f'{name}/variance'] = mean, variance
        else:
            mean = self._statistics[f'{name}/mean']
            variance = self._statistics[f'{name}/variance']
        gain = self._weights[f'{name}/scale'] / jnp.sqrt(variance + EPSILON)
        return jax.nn.relu(y * gain + (self._weights[f'{name}/shift'] - mean * gain))

    def linear(self, name: str, x: Any, channels: int) -> Any:
        return _convolved(x, self._weights[f'{name}/weight'], 1) + self._weights[f'{name}/bias']

    def add(self, name: str, a: Any, b: Any) -> Any:
        return a + b

    def double(self, name: str, x: Any) -> Any:
        return jnp.repeat(jnp.repeat(x, 2, axis=1), 2, axis=2)


def outputs(
    weights: Weights, statistics: Statistics, batch: Any, is_training: bool = False
) -> tuple[list[Any], Statistics]:
    """
    Run the network on a batch.

    Parameters
    ----------
    weights
        What was trained.
    statistics
        The mean and variance of what comes out of the convolutions.
    batch
        Pictures (n, height, width, 3), 0 to 1; sides are multiples of 32.
    is_training
        Whether to normalise by the batch instead of by the statistics.

    Returns
    -------
    list, Statistics
        For each stride (n, height / stride, width / stride, OUTPUTS), and the statistics of the
        batch when training.

    """
    ops = _Jax(weights, statistics, is_training)
    return network(ops, batch), ops.seen


def _convolved(x: Any, weight: Any, stride: int) -> Any:
    """Convolve with a border of zeros, the same above and below, as ONNX does it."""
    border = weight.shape[0] // 2
    return jax.lax.conv_general_dilated(
        x,
        weight,
        (stride, stride),
        ((border, border), (border, border)),
        dimension_numbers=('NHWC', 'HWIO', 'NHWC'),
    )
