import type { Mechanism } from "./api";
import { figure } from "./numbers";
import { Table } from "./parts";

/** Which mechanism goes with toughness among the patterns of a family. */
export function MechanismTable({ family, mechanisms }: { family: string; mechanisms: Mechanism[] }) {
  return (
    <Table
      name={`mechanisms-${family}`}
      caption={`What goes with toughness in ${family}, at equal rigid fraction and modulus (evidence, not cause)`}
      rows={mechanisms}
      rowKey={(m) => m.mechanism}
      empty="No cracks of this family were looked at (nacre families --cracks)."
      columns={[
        { heading: "mechanism", words: true, show: (m) => m.mechanism.replace("_", " "), value: (m) => m.mechanism },
        { heading: "patterns", show: (m) => m.patterns, value: (m) => m.patterns },
        {
          heading: "rank correlation",
          csv: "spearman_with_toughness",
          show: (m) => figure(m.spearman_with_toughness, 2),
          value: (m) => m.spearman_with_toughness,
        },
        { heading: "partial", show: (m) => figure(m.partial, 2), value: (m) => m.partial },
        {
          heading: "p, family-wise",
          csv: "p_family_wise",
          show: (m) => figure(m.p_family_wise, 2),
          value: (m) => m.p_family_wise,
        },
      ]}
    />
  );
}
