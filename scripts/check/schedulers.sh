#!/usr/bin/env bash
# Gives the files of docs/reference/schedulers.md, and a bundle's for OpenJD and Kubernetes, to the schedulers' own programs or parsers:
# HTCondor, Kubernetes' schema, botocore, OpenJD from PyPI in a virtual environment, Nextflow from Maven Central; both below
# build/schedulers, kept. make, Slurm and Snakemake are among the tests. The last line says "cases N failures M".
#
#   scripts/check/schedulers.sh PROGRAM
set -euo pipefail
cd "$(dirname "$0")/../.."
program=$(realpath "${1:?usage: scripts/check/schedulers.sh PROGRAM}")
home=$PWD/build/schedulers
nextflow_version=23.10.1

if [[ ! -e $home/nextflow/.whole ]]; then
  rm -rf "$home"
  mkdir -p "$home/nextflow"
  /usr/bin/python3 -m venv "$home/python"
  "$home/python/bin/pip" install --quiet --disable-pip-version-check htcondor==25.14.1 kubernetes-validate==1.31.0 botocore openjd-cli==0.8.0 pyyaml
  cat >"$home/nextflow/pom.xml" <<END
<project xmlns="http://maven.apache.org/POM/4.0.0"><modelVersion>4.0.0</modelVersion>
<groupId>none</groupId><artifactId>none</artifactId><version>1</version><dependencies><dependency>
<groupId>io.nextflow</groupId><artifactId>nextflow</artifactId><version>$nextflow_version</version></dependency></dependencies></project>
END
  mvn --quiet --file "$home/nextflow/pom.xml" dependency:copy-dependencies -DoutputDirectory="$home/nextflow/lib"
  touch "$home/nextflow/.whole"
fi
PATH=$home/python/bin:$PATH NEXTFLOW_LIBRARIES="$home/nextflow/lib/*" \
  "$home/python/bin/python" -B tests/farm/real_schedulers.py "$program"
