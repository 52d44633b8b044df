# SPDX-License-Identifier: Apache-2.0
"""The values of a message as the command line gives them."""

from __future__ import annotations

from typing import Any

import yaml


def parse_values(text: str) -> dict[str, Any]:
    """Return the mapping that a text in YAML stands for."""
    try:
        values = yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise RuntimeError(f'The passed value is no YAML: {error}') from error
    if values is None:
        return {}
    if not isinstance(values, dict):
        raise RuntimeError('The passed value needs to be a dictionary in YAML format')
    return values
