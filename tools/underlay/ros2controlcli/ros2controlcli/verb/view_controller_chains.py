# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 control view_controller_chains`."""

from __future__ import annotations

import argparse
from pathlib import Path

from ros2controlcli.manager import add_manager_arguments, connected
from ros2controlcli.verb import VerbExtension

SOURCE = Path('/tmp/controller_diagram.gv')


class ViewControllerChainsVerb(VerbExtension):
    """Draw the loaded controllers and their chains."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the option for the controller manager.

        Parameters
        ----------
        parser
            The parser of the verb.
        cli_name
            The name of the program, which is not used.

        """
        add_manager_arguments(parser)

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Draw the controllers and the hardware: as a PDF, or as an SVG without Graphviz.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed command line.

        Returns
        -------
        int, str or None
            None if the diagram is drawn, else the message that says why not.

        """
        with connected(args) as manager:
            controllers = manager.ask('list_controllers').controller
            components = manager.ask('list_hardware_components').component
        from ros2controlcli.diagram import as_dot, as_svg, diagram_of
        from tf2_tools.drawing import draw, has_graphviz

        diagram = diagram_of(controllers, components)
        target = SOURCE.with_name(f'{SOURCE.name}.{"pdf" if has_graphviz() else "svg"}')
        try:
            SOURCE.write_text(as_dot(diagram), encoding='utf-8')
            if target.suffix == '.svg':
                target.write_text(as_svg(diagram), encoding='utf-8')
        except OSError as error:
            return f'{error.filename} cannot be written: {error.strerror}. Remove it, if it is old'
        if target.suffix == '.pdf' and (problem := draw(str(SOURCE), str(target), bool)):
            return problem
        hint = (
            '' if target.suffix == '.pdf' else ' (an SVG: Graphviz, for a PDF, is not installed)'
        )
        print(f'Drawn: {target}{hint}')
        return None
