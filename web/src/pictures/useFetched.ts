// What the server is asked for while a part of the page is there.
import { useEffect, useState } from "react";

/** What a fetch gave; null while it comes, "failed" where it gave nothing. It is fetched anew where `fetch` is another. */
export function useFetched<T>(fetch: () => Promise<T>): T | "failed" | null {
  const [got, setGot] = useState<{ by: () => Promise<T>; value: T | "failed" } | null>(null);
  useEffect(() => {
    let wanted = true;
    const take = (value: T | "failed") => wanted && setGot({ by: fetch, value });
    fetch().then(take, () => take("failed"));
    return () => {
      wanted = false;
    };
  }, [fetch]);
  return got?.by === fetch ? got.value : null;
}
