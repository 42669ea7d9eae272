#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The Kubernetes manifests and the compose file ask for what there is: check_kubernetes.py ROOT

Options are in the table of options, figures among the server's, paths among those that it answers; and what the
manifests say of each other fits: labels, ports, volumes, the time to drain."""
import re
import sys
from pathlib import Path

import yaml

from check_monitoring import figures_of_the_server

ROOT = Path(sys.argv[1])
FOLDER = ROOT / "deploy/kubernetes"
FROM_OUTSIDE = {"raybundle", "raybundle-metrics", "raybundle-tls"}  # secrets that an operator makes
DRAIN_SECONDS = 10  # README.md: "the program ends within seconds"; docker, too, waits so long

failures = []


def require(holds, text):
    if not holds:
        failures.append(text)


def documents(file):
    return [document for document in yaml.safe_load_all(file.read_text()) if document]


def flags_of_the_server():
    """--tls-cert of OptionRow{"tlsCert", ...}, and those that are in no table."""
    table = (ROOT / "server/options/option_table.cpp").read_text()
    keys = re.findall(r'OptionRow\{\s*"(\w+)"', table)
    return {"--" + re.sub(r"[A-Z]", lambda letter: "-" + letter[0].lower(), key) for key in keys} | {"--config"}


def check_arguments(where, arguments, flags):
    for argument in arguments:
        if argument.startswith("--"):
            require(argument.split("=")[0] in flags, f"{where}: no option {argument}")


def paths_of(probe):
    return [probe["httpGet"]["path"]] if "httpGet" in probe else []


def check_container(where, container, pod, claims):
    ports = {port["name"] for port in container.get("ports", [])}
    for name in ("livenessProbe", "readinessProbe"):
        probe = container.get(name)
        require(probe, f"{where}: no {name}")
        action = probe.get("httpGet") or probe["tcpSocket"]
        require(action["port"] in ports, f"{where}: {name} asks a port that there is not")
    volumes = {volume["name"] for volume in pod.get("volumes", [])} | claims
    mounted = {mount["name"] for mount in container.get("volumeMounts", [])}
    require(mounted <= volumes, f"{where}: mounts {mounted - volumes}, which there is not")
    require(volumes <= mounted, f"{where}: {volumes - mounted} is not mounted")
    require(container["securityContext"]["readOnlyRootFilesystem"], f"{where}: may write its own files")
    for variable in container.get("env", []):
        reference = variable.get("valueFrom", {}).get("secretKeyRef")
        require(not reference or reference["name"] in FROM_OUTSIDE, f"{where}: no secret {reference}")
    sleep = container.get("lifecycle", {}).get("preStop", {}).get("exec", {}).get("command", ["sleep", "0"])
    require(pod["terminationGracePeriodSeconds"] >= int(sleep[1]) + DRAIN_SECONDS, f"{where}: no time to drain")


def check_workload(workload):
    where = workload["metadata"]["name"]
    template = workload["spec"]["template"]
    labels = template["metadata"]["labels"]
    require(workload["spec"]["selector"]["matchLabels"].items() <= labels.items(), f"{where}: selects other pods")
    claims = {claim["metadata"]["name"] for claim in workload["spec"].get("volumeClaimTemplates", [])}
    for container in template["spec"]["containers"]:
        check_container(where, container, template["spec"], claims)
    return labels, {port["name"] for c in template["spec"]["containers"] for port in c.get("ports", [])}


def check_server(workload, flags):
    container = workload["spec"]["template"]["spec"]["containers"][0]
    check_arguments("raybundle", container["args"], flags)
    answers = (ROOT / "server/net/http/http_response.cpp").read_text()
    for name in ("livenessProbe", "readinessProbe"):
        for path in paths_of(container[name]):
            require(f'"{path}"' in answers, f"{name}: the server has no {path}")
    require("replicas" not in workload["spec"], "the autoscaler's number would be taken back with each apply")


def check_references(by_kind, pods):
    """Services, policies and monitors select pods that there are, by ports that they have."""
    for service in by_kind["Service"]:
        labels, ports = pods[service["metadata"]["name"]]
        require(service["spec"]["selector"].items() <= labels.items(), "a Service selects no pod")
        require({port["targetPort"] for port in service["spec"]["ports"]} <= ports, "a Service has no port")
    for kind in ("PodMonitor", "PodDisruptionBudget"):
        for document in by_kind[kind]:
            selected = document["spec"]["selector"]["matchLabels"]
            require(any(selected.items() <= labels.items() for labels, _ in pods.values()), f"{kind}: no such pod")
    scaled = by_kind["HorizontalPodAutoscaler"][0]["spec"]["scaleTargetRef"]
    require(scaled["name"] in pods and scaled["kind"] == "StatefulSet", "nothing to scale")
    services = {service["metadata"]["name"] for service in by_kind["Service"]}
    for path in by_kind["Ingress"][0]["spec"]["rules"][0]["http"]["paths"]:
        require(path["backend"]["service"]["name"] in services, "the Ingress leads nowhere")


def check_figures(by_kind):
    known = figures_of_the_server(ROOT)
    names = [metric["pods"]["metric"]["name"]
             for scaler in by_kind["HorizontalPodAutoscaler"] for metric in scaler["spec"]["metrics"]]
    names += re.findall(r"raybundle_[a-z_]+", (FOLDER / "autoscaling.yaml").read_text())
    for name in names:
        require(name in known, f"no figure {name}")


def check_compose(flags):
    compose = yaml.safe_load((ROOT / "deploy/cluster/compose.yaml").read_text())
    for name, service in compose["services"].items():
        if service["image"] == "raybundle":
            check_arguments(f"compose.yaml: {name}", service["command"], flags)


def main():
    flags = flags_of_the_server()
    require(len(flags) > 30, "the table of options reads otherwise now")
    kustomization = documents(FOLDER / "kustomization.yaml")[0]
    files = {file.name for file in FOLDER.glob("*.yaml")} - {"kustomization.yaml"}
    require(set(kustomization["resources"]) == files, "kustomization.yaml names other files")
    everything = [document for name in sorted(files) for document in documents(FOLDER / name)]
    by_kind = {}
    for document in everything:
        by_kind.setdefault(document["kind"], []).append(document)
    pods = {workload["metadata"]["name"]: check_workload(workload) for workload in by_kind["StatefulSet"]}
    for workload in by_kind["StatefulSet"]:
        if workload["metadata"]["name"] == "raybundle":
            check_server(workload, flags)
    check_references(by_kind, pods)
    check_figures(by_kind)
    check_compose(flags)
    redis = by_kind["ConfigMap"][0]["data"]["redis.conf"]
    require(redis in (ROOT / "deploy/cluster/redis.conf").read_text(), "redis.conf is another one than compose.yaml's")
    for text in failures:
        print(text, file=sys.stderr)
    print(f"{len(everything)} objects, {len(failures)} failures")
    return 1 if failures or len(everything) < 8 else 0


if __name__ == "__main__":
    sys.exit(main())
