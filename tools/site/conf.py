# SPDX-License-Identifier: Apache-2.0
"""How Sphinx builds the site from the pages that build.py collects."""

from __future__ import annotations

from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.directives.code import CodeBlock
from sphinx.environment import BuildEnvironment
from sphinx.util.nodes import make_refnode

project = 'The humanoid workspace'
extensions = ['myst_parser', 'sphinx_copybutton']
root_doc = 'index'
myst_enable_extensions = ['colon_fence', 'fieldlist']
myst_heading_anchors = 4  # the anchors that code hosts give to headings
highlight_language = 'none'
smartquotes = False
add_module_names = False
python_maximum_signature_line_length = 120  # with the full names of types, which are hidden
python_use_unqualified_type_names = True
toc_object_entries = False  # a page has hundreds
html_theme = 'furo'
html_title = project
html_static_path = ['_static']
html_css_files = ['site.css']
html_show_sphinx = False
html_show_copyright = False
html_show_sourcelink = False
html_copy_source = False
copybutton_selector = 'div:not(.highlight-text) > div.highlight > pre'  # no button on output


class WrittenFile(CodeBlock):
    """A block that readers write to a file, with the file as its caption."""

    required_arguments = 2

    def run(self) -> list[nodes.Node]:
        """Make the second argument the caption."""
        self.options['caption'] = f'``{self.arguments.pop()}``'
        return [*super().run()]


def _type_of(
    app: Sphinx, env: BuildEnvironment, node: Any, short_name: nodes.Element
) -> nodes.Element | None:
    """Resolve a type in a signature that is no class here: an alias, or the type of a library."""
    if node.get('refdomain') != 'py' or node['reftype'] != 'class':
        return None
    target = node['reftarget']
    alias = env.domains['py'].data['objects'].get(target)
    if alias is None:
        return short_name
    to, place = alias.docname, alias.node_id
    return make_refnode(app.builder, node['refdoc'], to, place, [short_name], target)


def setup(app: Sphinx) -> None:
    """
    Add the directive and the resolution of types to Sphinx.

    Parameters
    ----------
    app
        The application that reads this configuration.

    """
    app.add_directive('written-file', WrittenFile)
    app.connect('missing-reference', _type_of)
