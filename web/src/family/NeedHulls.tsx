// Assets that have geometry, yet no hulls: making them.
import { Boxes } from "lucide-react";
import { api } from "../server/api";
import { useProject } from "../store/project";
import { complainedOf } from "../store/toasts";
import { Button } from "../ui/Button";
import css from "./family.module.css";

const make = (assets: string[]) => void api.startJob({ kind: "decompose", assets }).catch(complainedOf);

/** Whether an asset is waiting for hulls to be made. */
const useMaking = () =>
  useProject((state) => state.jobs.some((job) => job.kind === "decompose" && job.state === "running"));

export function NeedHulls() {
  const bare = useProject((state) =>
    state.order.filter((asset) => state.cards[asset]?.hulls === 0 && (state.cards[asset]?.sources ?? 0) > 0).join("\n"),
  );
  const making = useMaking();
  if (!bare || making) return null;
  const assets = bare.split("\n");
  return (
    <div className={css.notice}>
      <span>{assets.length === 1 ? "One asset has no hulls." : `${assets.length} assets have no hulls.`}</span>
      <Button icon={Boxes} onClick={() => make(assets)}>
        Make them
      </Button>
    </div>
  );
}

export function MakeHulls({ asset }: { asset: string }) {
  const making = useMaking();
  return (
    <Button
      icon={Boxes}
      tip="Cut its geometry into convex hulls (CoACD)"
      disabled={making}
      onClick={(event) => {
        event.stopPropagation();
        make([asset]);
      }}
    >
      Make hulls
    </Button>
  );
}
