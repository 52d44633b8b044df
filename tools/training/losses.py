# SPDX-License-Identifier: Apache-2.0
"""What training makes small."""

from __future__ import annotations

from typing import Any

from boxes import Cells, decoded
import jax
import jax.numpy as jnp

_LEAST_TARGET = 0.2
"""The score that a cell of a thing learns even while its box does not fit at all."""
_BOX_WEIGHT = 2.0


def flat(outputs: list[Any]) -> Any:
    """
    Concatenate the outputs of all strides.

    Parameters
    ----------
    outputs
        For each stride (n, height, width, outputs).

    Returns
    -------
    Any
        (n, cells, outputs).

    """
    return jnp.concatenate(
        [each.reshape(each.shape[0], -1, each.shape[-1]) for each in outputs], axis=1
    )


def loss(outputs: Any, cells: Cells, boxes: Any, classes: Any, weights: Any) -> Any:
    """
    Compute the quality focal loss of scores and the generalised IoU loss of boxes, as one number.

    Scores learn how well the box fits (Li et al., 2020, Generalized Focal Loss); boxes learn by
    the generalised intersection over union (Rezatofighi et al., 2019).

    Parameters
    ----------
    outputs
        (n, cells, 4 + classes) of the network; scores are logits.
    cells
        Where its cells are.
    boxes
        (n, cells, 4) x1, y1, x2, y2 in pixels that cells should predict.
    classes
        (n, cells), -1 where nothing is.
    weights
        (n, cells), 0 where nothing can be learned.

    """
    predicted = decoded(jnp, outputs[..., :4], cells)
    half = predicted[..., 2:] / 2
    fit, generalised = _overlap(predicted[..., :2] - half, predicted[..., :2] + half, boxes)
    is_thing = classes >= 0
    quality = jnp.maximum(jax.lax.stop_gradient(fit), _LEAST_TARGET) * is_thing
    logits = outputs[..., 4:]
    target = jax.nn.one_hot(classes, logits.shape[-1]) * quality[..., None]
    surprise = (jax.nn.sigmoid(logits) - target) ** 2
    entropy = jax.nn.softplus(logits) - target * logits
    normaliser = jnp.maximum(quality.sum(), 1.0)
    score_loss = (surprise * entropy * weights[..., None]).sum() / normaliser
    box_loss = (quality * (1.0 - generalised)).sum() / normaliser
    return score_loss + _BOX_WEIGHT * box_loss


def _overlap(low: Any, high: Any, boxes: Any) -> tuple[Any, Any]:
    """Return IoU and generalised IoU of boxes, (..., 2) each corner, with boxes (..., 4)."""
    other_low, other_high = boxes[..., :2], boxes[..., 2:]
    shared = jnp.maximum(jnp.minimum(high, other_high) - jnp.maximum(low, other_low), 0.0)
    shared = shared[..., 0] * shared[..., 1]
    edges, others = high - low, other_high - other_low
    union = edges[..., 0] * edges[..., 1] + others[..., 0] * others[..., 1] - shared + 1e-6
    hull = jnp.maximum(high, other_high) - jnp.minimum(low, other_low)
    around = hull[..., 0] * hull[..., 1] + 1e-6
    fit = shared / union
    return fit, fit - (around - union) / around
