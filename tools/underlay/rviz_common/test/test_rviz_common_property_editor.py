# SPDX-License-Identifier: Apache-2.0
"""Boxes for names that only turn up later."""

from types import SimpleNamespace

import pytest
from rviz_common.page import NO_TOKEN, Page, PageSettings
from rviz_common.panels.property_editor import FlagsFolder
from rviz_common.properties import Flags, Values

NAMES = Flags('Namespaces', {}, 'Which are shown.')


def test_flags_are_read_as_the_file_has_them():
    """There is a flag for each name, whatever is in it; all else is refused."""
    values = Values([NAMES], {'Namespaces': {'a/b': True, 7: False}})
    assert values['Namespaces'] == {'a/b': True, '7': False}
    for wrong in ('yes', {'a': 1}, [True]):
        with pytest.raises(ValueError, match='true or false'):
            values['Namespaces'] = wrong


def test_boxes_come_with_their_names():
    """A new name gets a box; what a program or a person sets is in the other, too."""
    values = Values([NAMES], {'Namespaces': {'a': True}})
    taken = {}
    with Page('test', PageSettings(token=NO_TOKEN)) as page:
        context = SimpleNamespace(
            gui=page.viser.gui, on_input=lambda box, take: taken.update({box.label: take})
        )
        folder = FlagsFolder(context, NAMES, values, values.__setitem__)
        values['Namespaces'] = {'a': False, 'b': True}
        folder.update()
        assert {name: box.value for name, box in folder._boxes.items()} == {'a': False, 'b': True}
        taken['b'](False)
    assert values['Namespaces'] == {'a': False, 'b': False}
