# SPDX-License-Identifier: Apache-2.0
"""An RViz configuration with displays that only some launches need."""

from __future__ import annotations

from pathlib import Path
from tempfile import NamedTemporaryFile

from launch import LaunchContext, SomeSubstitutionsType, Substitution
from launch.substitutions import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
import yaml

__all__ = ['RvizFile']


class RvizFile(Substitution):
    """
    Substitution for the path of an RViz configuration that has the displays of another as well.

    Parameters
    ----------
    base
        The path of a configuration.
    added
        The path of one whose displays are appended to those of the first.
    condition
        Append the displays only if this is 'true'; otherwise the path is that of the first file.

    """

    def __init__(
        self,
        base: SomeSubstitutionsType,
        added: SomeSubstitutionsType,
        condition: SomeSubstitutionsType,
    ) -> None:
        super().__init__()
        self._base, self._added, self._condition = (
            normalize_to_list_of_substitutions(each) for each in (base, added, condition)
        )

    def describe(self) -> str:
        """Return a human-readable description."""
        return 'RvizFile()'

    def perform(self, context: LaunchContext) -> str:
        """
        Resolve the path; if the condition holds, write the file that has the displays of both.

        Parameters
        ----------
        context
            The launch context.

        Returns
        -------
        str
            The path of a temporary file, or of the first file itself.

        Raises
        ------
        SubstitutionFailure
            A file cannot be read or written.

        """
        base = perform_substitutions(context, self._base)
        if perform_substitutions(context, self._condition).lower() != 'true':
            return base
        added = perform_substitutions(context, self._added)
        try:
            return str(_joined(Path(base), Path(added)))
        except (OSError, KeyError, TypeError, yaml.YAMLError) as error:
            raise SubstitutionFailure(
                f"The displays of '{added}' cannot be added to '{base}': {error}. Correct the "
                'files, or start without gui.'
            ) from error


def _joined(base: Path, added: Path) -> Path:
    """Write a temporary file with all displays, as a dry run has no log directory."""
    content, more = (yaml.safe_load(path.read_text(encoding='utf-8')) for path in (base, added))
    content['Visualization Manager']['Displays'] += more['Visualization Manager']['Displays']
    with NamedTemporaryFile(
        'w', encoding='utf-8', prefix=f'{base.stem}_', suffix='.rviz', delete=False
    ) as file:
        yaml.safe_dump(content, file, sort_keys=False)
    return Path(file.name)
