# SPDX-License-Identifier: Apache-2.0
"""
Install the navigation packages, each under its own name.

`packages.yaml` describes their contents. It determines the entries in the ament resource index,
the executables, which are scripts of a few lines, and the list of components.
"""

from pathlib import Path

from setuptools import find_packages, setup
from setuptools.command.install import install
import yaml

package_name = 'navigation2'
HERE = Path(__file__).resolve().parent
SHARED = ('behavior_trees', 'config', 'launch', 'maps', 'params', 'rviz')
"""The folders of a package that are installed to its share folder."""

PACKAGES = yaml.safe_load((HERE / 'packages.yaml').read_text(encoding='utf-8'))

PANEL = 'nav2_rviz_plugins/Navigation 2 = nav2_rviz_plugins.navigation_panel:NavigationPanel'

SCRIPT = """\
#!/usr/bin/env python3
import sys

from {module} import {function}

sys.exit({function}())
"""
NODE_SCRIPT = """\
#!/usr/bin/env python3
import sys

from {module} import {function}
from nav2_util.main import main

sys.exit(main({function}))
"""
MANIFEST = """\
<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>0.1.0</version>
  <description>{description}</description>
  <maintainer email="{email}">{maintainer}</maintainer>
  <license>Apache-2.0</license>
  <exec_depend>navigation2</exec_depend>
  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
"""


class Install(install):
    """Install command that also generates files from `packages.yaml`."""

    def run(self):
        """Install the package and the generated files."""
        super().run()
        for name, package in PACKAGES.items():
            self._write(f'share/ament_index/resource_index/packages/{name}', '')
            manifest = MANIFEST.format(
                name=name,
                description=package['description'],
                maintainer=self.distribution.get_maintainer(),
                email=self.distribution.get_maintainer_email(),
            )
            self._write(f'share/{name}/package.xml', manifest)
            components = package.get('components', {})
            if components:
                lines = ''.join(f'{each};{place}\n' for each, place in components.items())
                self._write(f'share/ament_index/resource_index/rclcpp_components/{name}', lines)
            for executable, place in package.get('executables', {}).items():
                module, _, function = place.partition(':')
                template = NODE_SCRIPT if function[0].isupper() else SCRIPT
                text = template.format(module=module, function=function)
                self._write(f'lib/{name}/{executable}', text, mode=0o755)

    def _write(self, place, text, mode=0o644):
        path = Path(self.install_data) / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding='utf-8')
        path.chmod(mode)


def shared_files():
    """Collect the files of the packages' share folders, in the format of setup()."""
    found = []
    for name in PACKAGES:
        for folder in SHARED:
            if (HERE / name / folder / '__init__.py').exists():
                continue  # a module, not a shared file
            for path in sorted((HERE / name / folder).glob('**/*')):
                if path.is_file():
                    place = path.parent.relative_to(HERE / name)
                    found.append((f'share/{name}/{place}', [str(path.relative_to(HERE))]))
    return found


setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={name: ['py.typed', 'web/*'] for name in find_packages(exclude=['test'])},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        *shared_files(),
    ],
    cmdclass={'install': Install},
    entry_points={
        'rviz_common.displays': [
            'nav2_rviz_plugins/ParticleCloud = nav2_rviz_plugins.particle_cloud:ParticleCloud',
        ],
        'rviz_common.tools': ['nav2_rviz_plugins/GoalTool = nav2_rviz_plugins.goal_tool:GoalTool'],
        'rviz_common.panels': [PANEL],
        'rviz_common.panels_on_demand': [PANEL],
    },
    install_requires=['setuptools'],
    zip_safe=False,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description="Nav2's packages: nodes, plugins and launch files that find the robot's way.",
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
)
