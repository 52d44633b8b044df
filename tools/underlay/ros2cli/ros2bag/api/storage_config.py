# SPDX-License-Identifier: Apache-2.0
"""Settings of MCAP files from a YAML file, as rosbag2 has them; this does not import rclpy."""

from __future__ import annotations

from typing import Any

from ros2bag.storage import BagError
from ros_environment.suggestions import did_you_mean

__all__ = ['COMPRESSIONS', 'read_storage_config']

COMPRESSIONS = {'None': 'none', 'Lz4': 'lz4', 'Zstd': 'zstd'}
WITHOUT = 'this recorder always writes them: reading and recovering a bag need them'
FIXED = {
    'noChunkCRC': (False, WITHOUT),
    'noSummaryCRC': (False, WITHOUT),
    'noChunking': (False, WITHOUT),
    'noMessageIndex': (False, WITHOUT),
    'noSummary': (False, WITHOUT),
    'compressionLevel': ('Default', 'there is one level only'),
}
"""Settings that have one possible value here, and why."""
EITHER = ('noAttachmentCRC', 'enableDataCRC', 'forceCompression')
"""Settings that make no difference: there are no attachments, and always a checksum."""
KNOWN = (*FIXED, *EITHER, 'chunkSize', 'compression')


def read_storage_config(path: str | None) -> dict[str, Any]:
    """
    Read the settings of the MCAP writer.

    Parameters
    ----------
    path
        A YAML file with a mapping, or None for no settings.

    Returns
    -------
    dict of str to Any
        `compression`: `none`, `lz4` or `zstd`, and `chunk_bytes`, as far as the file has them.

    Raises
    ------
    BagError
        The file cannot be read, or has a setting that is unknown or not possible here.

    """
    if not path:
        return {}
    settings = _mapping(path)
    for name, value in settings.items():
        if name not in KNOWN:
            hint = did_you_mean(str(name), KNOWN)
            raise BagError(f"'{path}': there is no setting '{name}'. {hint}".rstrip())
        wanted, reason = FIXED.get(name, (value, ''))
        if value != wanted:
            raise BagError(f"'{path}': {name} can only be {_yaml(wanted)}: {reason}")
    found: dict[str, Any] = {}
    if 'compression' in settings:
        found['compression'] = _compression(path, settings['compression'])
    if 'chunkSize' in settings:
        size = settings['chunkSize']
        if not isinstance(size, int) or size <= 0:
            raise BagError(f"'{path}': chunkSize has to be a number of bytes, not {size!r}")
        found['chunk_bytes'] = size
    return found


def _mapping(path: str) -> dict[str, Any]:
    import yaml

    try:
        with open(path, encoding='utf-8') as stream:
            content = yaml.safe_load(stream)
    except (OSError, ValueError, yaml.YAMLError) as error:
        raise BagError(f"The storage configuration '{path}' cannot be read: {error}") from error
    if not isinstance(content or {}, dict):
        raise BagError(
            f"'{path}' is not a storage configuration: it has no 'setting: value' lines"
        )
    return content or {}


def _compression(path: str, value: Any) -> str:
    name = 'None' if value is None else str(value)
    if name not in COMPRESSIONS:
        raise BagError(
            f"'{path}': there is no compression {value!r}. There are: {', '.join(COMPRESSIONS)}"
        )
    return COMPRESSIONS[name]


def _yaml(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
