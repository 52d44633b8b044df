# SPDX-License-Identifier: Apache-2.0
"""Installation of the package."""

from setuptools import find_packages, setup

package_name = 'image_transport'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={package_name: ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{package_name}']),
        (f'share/{package_name}', ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='Images as JPEG, PNG and compressed depth: programs and a Python library.',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
    entry_points={
        'console_scripts': [
            'list_transports = image_transport.list_transports:main',
            'republish = image_transport.republish:main',
        ],
    },
)
