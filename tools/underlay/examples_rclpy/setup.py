# SPDX-License-Identifier: Apache-2.0
"""Install the packages of `packages.yaml`, each under its own name."""

from pathlib import Path

from setuptools import find_packages, setup
from setuptools.command.install import install
import yaml

package_name = 'examples_rclpy'
PACKAGES = yaml.safe_load(
    (Path(__file__).resolve().parent / 'packages.yaml').read_text(encoding='utf-8')
)
SCRIPT = """\
#!/usr/bin/env python3
import sys

from {package}.{module} import main

sys.exit(main())
"""
MANIFEST = """\
<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>0.1.0</version>
  <description>{description}</description>
  <maintainer email="{email}">{maintainer}</maintainer>
  <license>Apache-2.0</license>
  <exec_depend>examples_rclpy</exec_depend>
  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
"""


class Install(install):
    """Install command that also writes the manifests and executables of the packages."""

    def run(self):
        """Install the modules, and what is written."""
        super().run()
        for name, package in PACKAGES.items():
            manifest = MANIFEST.format(
                name=name,
                description=package['description'],
                maintainer=self.distribution.get_maintainer(),
                email=self.distribution.get_maintainer_email(),
            )
            self._write(f'share/ament_index/resource_index/packages/{name}', '')
            self._write(f'share/{name}/package.xml', manifest)
            for module in package['executables']:
                text = SCRIPT.format(package=name, module=module)
                self._write(f'lib/{name}/{module}', text, mode=0o755)

    def _write(self, place, text, mode=0o644):
        path = Path(self.install_data) / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding='utf-8')
        path.chmod(mode)


setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={name: ['py.typed'] for name in PACKAGES},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{package_name}']),
        (f'share/{package_name}', ['package.xml']),
    ],
    cmdclass={'install': Install},
    install_requires=['setuptools'],
    zip_safe=False,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='Short nodes that show how to use rclpy, in packages of their own names.',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
)
