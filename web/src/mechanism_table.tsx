// Which mechanism goes with toughness among the patterns of a family.

import type { Mechanism } from "./api";
import { figure } from "./numbers";
import { Table } from "./parts";
import { TERMS } from "./terms";

export function MechanismTable({ family, mechanisms }: { family: string; mechanisms: Mechanism[] }) {
  return (
    <Table
      name={`mechanisms-${family}`}
      caption={`Mechanisms that go with toughness in ${family} (a correlation is no proof of a cause)`}
      rows={mechanisms}
      rowKey={(m) => m.mechanism}
      empty="The cracks of this family were not analysed: nacre families --cracks does it."
      columns={[
        { ...TERMS.mechanism, words: true, show: (m) => m.mechanism.replaceAll("_", " "), value: (m) => m.mechanism },
        { ...TERMS.patterns, show: (m) => m.patterns, value: (m) => m.patterns },
        {
          ...TERMS.rank,
          csv: "spearman_with_toughness",
          show: (m) => figure(m.spearman_with_toughness, 2),
          value: (m) => m.spearman_with_toughness,
        },
        { ...TERMS.partial, csv: "partial", show: (m) => figure(m.partial, 2), value: (m) => m.partial },
        {
          ...TERMS.mechanismChance,
          csv: "p_family_wise",
          show: (m) => figure(m.p_family_wise, 2),
          value: (m) => m.p_family_wise,
        },
      ]}
    />
  );
}
