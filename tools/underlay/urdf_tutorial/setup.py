# SPDX-License-Identifier: Apache-2.0
"""Installation of the package."""

from glob import glob

from setuptools import setup

package_name = 'urdf_tutorial'

setup(
    name=package_name,
    version='0.1.0',
    packages=[],
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{package_name}']),
        (f'share/{package_name}', ['package.xml']),
        (f'share/{package_name}/launch', ['launch/display.launch.py']),
        (f'share/{package_name}/urdf', sorted(glob('urdf/*'))),
    ],
    install_requires=['setuptools'],
    zip_safe=False,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='The models of the URDF tutorials: a cart that is built step by step.',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
)
